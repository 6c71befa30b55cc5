// Explains executions to browsers: the next one of a running system, and the last one if time is paused.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/web/site.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/past_execution.hpp"

namespace nezumi::web {

class Explanations {
public:
    using Clock = PastRun::Clock;
    using Send = std::function<void(ClientId client, std::string message)>;

    /// The largest number of waiting requests.
    static constexpr std::size_t most = 64;

    Explanations(RunningSystem& live, const ClockControl& clock, Send send)
        : live_(live), clock_(clock), send_(std::move(send)) {}

    /// In a paused simulation, explains the last execution, and for a behaviour in ERROR the failed execution; both are
    /// computed again. Otherwise explains the next execution.
    Expected<void> ask(ClientId client, const std::string& component);
    void forget(ClientId client);
    /// Call it between two ticks. Computes until this time, at least a little. Returns whether there is more to
    /// compute.
    bool serve(Clock::time_point until);

private:
    struct Asked {
        ClientId client = 0;
        std::string component;
        int generation = 0;
        bool is_over = false;                   // whether the execution is in the past
        std::int64_t trace = 0;                 // number of the trace of a coming execution
        std::unique_ptr<PastExecution> past{};  // of an execution in the past; null: not begun
    };

    bool is_answered(Asked& asked, Clock::time_point until, bool& computes);
    bool is_computed(Asked& asked, Clock::time_point until, bool& computes);
    bool waits_for_next(Asked& asked, const Error& why);
    void tell_of_pause(const Asked& asked);
    void look_ahead(const std::string& component);
    void take_stepped();
    bool is_known(const std::string& component) const;
    void tell(const Asked& asked, const Expected<Explanation>& explained);

    RunningSystem& live_;
    const ClockControl& clock_;
    Send send_;
    std::vector<Asked> asked_;
    // The last execution that was explained while time was paused, and `RunningSystem::generation` at that time.
    std::optional<Explanation> known_;
    int known_generation_ = 0;
    // A trace of the execution after it, so that after one step its explanation is available without computing the
    // past.
    std::optional<Asked> ahead_;
};

}  // namespace nezumi::web

// Values from before what the run remembers, for the page's time line and plots: computed while the run goes on.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/web/site.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/past_values.hpp"

namespace nezumi::web {

/// What is asked for is computed in order, between two ticks. The second system stays for a while, because a slider of
/// time asks again and again.
class Earlier {
public:
    using Clock = PastRun::Clock;
    using Send = std::function<void(ClientId client, std::string message)>;
    /// The answer to a request for a port, when it is over.
    using Answer = std::function<void(ClientId client, std::int64_t id, const Expected<void>& done)>;

    /// Plots that may wait.
    static constexpr std::size_t most = 64;

    Earlier(RunningSystem& live, const ClockControl& clock, Send send, Answer answer)
        : live_(live), clock_(clock), send_(std::move(send)), answer_(std::move(answer)) {}

    /// Answers immediately with what is remembered, and again when the rest is computed. A later time that the same
    /// client asks for replaces one that waits. Where the past can't be computed, there is no second answer.
    void ask_then(ClientId client, double at, const std::vector<std::string>& names);
    /// Computes all numbers of a port since the last start, up to now.
    Expected<void> ask_port(ClientId client, std::int64_t id, const std::string& port);
    void forget(ClientId client);
    /// Computes until this time. Returns whether there is more to compute.
    bool serve(Clock::time_point until);

private:
    struct Asked {
        ClientId client = 0;
        std::int64_t id = 0;
        std::string port{};  // "": values of a time
        std::vector<std::string> names{}, channels{};
        double to = 0;  // [s]
        int generation = 0;
    };

    Expected<void> begin(const Asked& asked);
    Expected<bool> compute(const Asked& asked, Clock::time_point until);
    void tell(const Asked& asked);

    RunningSystem& live_;
    const ClockControl& clock_;
    Send send_;
    Answer answer_;
    std::vector<Asked> asked_;
    std::unique_ptr<PastValues> past_;  // of the first that is asked, or of the last one
    Clock::time_point used_{};
};

}  // namespace nezumi::web

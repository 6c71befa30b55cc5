// Values that are older than what the run remembers, for the page's time line and plots. They are computed again while
// the run goes on.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings/web/site.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/past_values.hpp"

namespace nezumi::web {

/// Computes requested values in order, between two ticks, by a second system. That system is kept for a while, because
/// a slider of time makes many requests.
class Earlier {
public:
    using Clock = PastRun::Clock;
    using Send = std::function<void(ClientId client, std::string message)>;
    /// The answer to a request for a port, when it is over.
    using Answer = std::function<void(ClientId client, std::int64_t id, const Expected<void>& done)>;

    /// The largest number of waiting plots.
    static constexpr std::size_t most = 64;

    Earlier(RunningSystem& live, const ClockControl& clock, Send send, Answer answer)
        : live_(live), clock_(clock), send_(std::move(send)), answer_(std::move(answer)) {}

    /// Requests the values of ports and members at the time `at` [s]. Answers immediately with the remembered values,
    /// and once more when the others are computed; not if the past can't be computed. A new request of the same client
    /// replaces its waiting one.
    void ask_then(ClientId client, double at, const std::vector<std::string>& names);
    /// Computes all numbers of a port since the last start, up to now.
    Expected<void> ask_port(ClientId client, std::int64_t id, const std::string& port);
    void forget(ClientId client);
    /// Computes until `until`. Returns whether there is more to compute.
    bool serve(Clock::time_point until);

private:
    struct Asked {
        ClientId client = 0;
        std::int64_t id = 0;
        std::string port{};  // of a plot; "": the request is for the values at the time `to`
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
    std::unique_ptr<PastValues> past_;  // for the first request, or, if none waits, for the last one
    Clock::time_point used_{};
};

}  // namespace nezumi::web

// Goes back in time for browsers: the past is computed between two ticks, in slices.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "bindings/web/site.hpp"
#include "engine/live/clock_control.hpp"
#include "engine/live/past_run.hpp"

namespace nezumi::web {

class Seeks {
public:
    /// The answer to the request of a browser.
    using Answer = std::function<void(ClientId client, std::int64_t id, const Expected<void>& done)>;

    Seeks(RunningSystem& live, ClockControl& clock, Answer answer)
        : live_(live), clock_(clock), answer_(std::move(answer)) {}

    /// Pauses time and begins to go to `where`. Cancels an earlier request that is not finished.
    Expected<void> begin(ClientId client, std::int64_t id, const Actor& who, const Seek& where);
    /// Goes on until this time, at least a little. Returns whether there is more to do.
    bool serve(PastRun::Clock::time_point until);

private:
    RunningSystem& live_;
    ClockControl& clock_;
    Answer answer_;
    ClientId client_ = 0;
    std::int64_t id_ = 0;
    Actor who_;
    std::unique_ptr<PastRun> past_;  // null: no request
};

}  // namespace nezumi::web

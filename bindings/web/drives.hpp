// Ports that browsers hold with a stick: each only for as long as its browser says so again and again.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "bindings/web/messages.hpp"
#include "bindings/web/site.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi::web {

class Drives {
public:
    using Clock = std::chrono::steady_clock;
    /// Without a word from its browser for so long a drive ends: the port rests for a tick, then it is let go.
    static constexpr std::chrono::milliseconds longest_silence{500};

    /// Tells a browser that it does not drive a port, or no longer, and why.
    using Tell = std::function<void(ClientId, const std::string& port, const std::string& why)>;

    /// `live` must outlive it.
    Drives(RunningSystem& live, Tell tell) : live_(live), tell_(std::move(tell)) {}

    /// Begins a drive, goes on with it, or ends it. An error when it can't begin. All of it between two ticks.
    Expected<void> take(ClientId client, const DriveMessage& message, const Actor& who, Clock::time_point now);
    /// Ends what is due.
    void serve(Clock::time_point now);
    /// Its browser is gone, and what it held has been let go.
    void forget(ClientId client);

private:
    struct Drive {
        ClientId client = 0;
        Actor who;
        std::string port;
        Value value;
        Clock::time_point heard;
        std::int64_t rests_since = -1;  // the tick in which it came to rest; -1: it drives
        int start = 0;                  // of the system
    };

    bool has_it(const Drive& drive) const;
    void rest(Drive& drive);

    RunningSystem& live_;
    Tell tell_;
    std::vector<Drive> drives_;
};

/// What stands still, of the same type: zero, and so many zeros for so many numbers.
Value resting(const Value& value);

}  // namespace nezumi::web

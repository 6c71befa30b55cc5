// Ports that browsers hold with a joystick; a hold lasts only while the browser repeats its message.
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
    /// A drive without a message for this time ends: the port is zero for a tick, then it is released.
    static constexpr std::chrono::milliseconds longest_silence{500};

    /// Tells a browser that it does not drive the port, or does so no longer, with the reason.
    using Tell = std::function<void(ClientId, const std::string& port, const std::string& why)>;

    /// `live` must outlive this object.
    Drives(RunningSystem& live, Tell tell) : live_(live), tell_(std::move(tell)) {}

    /// Begins, continues or ends a drive. Fails if it can't begin. Call it between two ticks.
    Expected<void> take(ClientId client, const DriveMessage& message, const Actor& who, Clock::time_point now);
    /// Ends the drives that are overdue.
    void serve(Clock::time_point now);
    /// The browser has disconnected and its holds were released.
    void forget(ClientId client);

private:
    struct Drive {
        ClientId client = 0;
        Actor who;
        std::string port;
        Value value;
        Clock::time_point heard;
        std::int64_t rests_since = -1;  // the tick of the zero command; -1: the browser drives
        int start = 0;                  // number of the system's start
    };

    bool has_it(const Drive& drive) const;
    void rest(Drive& drive);

    RunningSystem& live_;
    Tell tell_;
    std::vector<Drive> drives_;
};

/// The value of the same type for standstill: zero, or the same number of zeros.
Value resting(const Value& value);

}  // namespace nezumi::web

// A drive is a hold of a port by a browser. A drive begins, changes and ends by acts, so a replay repeats it.
#include "bindings/web/drives.hpp"

#include <algorithm>
#include <utility>

namespace nezumi::web {

Value resting(const Value& value) {
    Value rest(value.type());
    if (value.type().kind == Type::Kind::sequence) ValuePlace(rest).resize(ValueView(value).count());
    return rest;
}

bool Drives::has_it(const Drive& drive) const {
    const auto port = live_.system().port(drive.port);
    const Actor* holder = live_.system().holder(drive.port);
    return drive.start == live_.generation() && port && (*port)->override() == Override::held && holder != nullptr &&
           *holder == drive.who;
}

Expected<void> Drives::take(ClientId client, const DriveMessage& message, const Actor& who, Clock::time_point now) {
    const auto found = std::find_if(drives_.begin(), drives_.end(), [&](const Drive& each) {
        return each.client == client && each.port == message.port;
    });
    if (!message.value) {
        if (found != drives_.end()) rest(*found);
        return {};
    }
    if (found != drives_.end() && has_it(*found)) {
        found->heard = now;
        if (found->rests_since < 0 && found->value == *message.value) return {};
        auto held = live_.act(Hold{message.port, *message.value}, who);
        if (!held) return Unexpected(held.error());
        found->value = *message.value;
        found->rests_since = -1;
        return {};
    }
    if (found != drives_.end()) drives_.erase(found);
    auto held = live_.act(Hold{message.port, *message.value, message.take}, who);
    if (!held) return Unexpected(held.error());
    live_.system().log(LogLevel::info, to_text(who) + ": drives " + message.port);
    drives_.push_back({client, who, message.port, *message.value, now, -1, live_.generation()});
    return {};
}

void Drives::rest(Drive& drive) {
    if (drive.rests_since >= 0) return;
    drive.rests_since = live_.system().now().tick;
    static_cast<void>(live_.act(Hold{drive.port, resting(drive.value)}, drive.who));  // has_it
}

void Drives::serve(Clock::time_point now) {
    for (Drive& drive : drives_) {
        if (!has_it(drive)) {
            if (drive.rests_since < 0)
                tell_(drive.client, drive.port, "another user drives this port, or the port was removed");
            drive.client = 0;
        } else if (drive.rests_since < 0 && now - drive.heard > longest_silence) {
            rest(drive);
        } else if (drive.rests_since >= 0 && live_.system().now().tick > drive.rests_since) {
            static_cast<void>(live_.act(Release{drive.port}, drive.who));
            live_.system().log(LogLevel::info, to_text(drive.who) + ": drives " + drive.port + " no longer");
            drive.client = 0;
        }
    }
    std::erase_if(drives_, [](const Drive& each) { return each.client == 0; });
}

void Drives::forget(ClientId client) {
    std::erase_if(drives_, [&](const Drive& each) { return each.client == client; });
}

}  // namespace nezumi::web

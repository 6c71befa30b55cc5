// The actor of an act on a running system.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// An actor owns the ports that it holds. Two actors are the same if kind and name are equal.
struct Actor {
    enum class Kind {
        run,      ///< the run itself
        console,  ///< all consoles of a user are one actor
        scenario,
        file_watcher,  ///< a file was saved
        spreadsheet,
        joystick,
        browser,  ///< each connection is an actor
        network,  ///< each peer is an actor
    };
    Kind kind = Kind::run;
    std::string name{};  ///< which one of several; "" if there is only one

    bool operator==(const Actor&) const = default;
};

/// The name of the actor in logs, journals and on ports: "console", "browser tablet".
std::string to_text(const Actor& who);
/// The actor of a text from `to_text`, or an error.
Expected<Actor> actor_from(std::string_view text);

}  // namespace nezumi

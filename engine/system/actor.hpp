// Who acts on a running system.
#pragma once

#include <string>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi {

/// Who acts. What an actor holds is its own: two are one when kind and name are equal.
struct Actor {
    enum class Kind {
        run,      ///< the run itself
        console,  ///< every console of a user is one
        scenario,
        file_watcher,  ///< a file was saved
        spreadsheet,
        joystick,
        browser,  ///< each connection is its own
        network,  ///< each peer is its own
    };
    Kind kind = Kind::run;
    std::string name{};  ///< which of several; "" where there is but one

    bool operator==(const Actor&) const = default;
};

/// "console", "browser tablet": as logs, journals and looks at ports name it.
std::string to_text(const Actor& who);
/// What `to_text` wrote, or an error.
Expected<Actor> actor_from(std::string_view text);

}  // namespace nezumi

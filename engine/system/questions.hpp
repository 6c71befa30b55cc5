// Requests to a component of another host.
#pragma once

#include <cstdint>
#include <string>

#include "engine/values/plain_data.hpp"

namespace nezumi {

struct Question {
    enum class What : std::uint8_t {
        look,  ///< the kind and the value of this name: `read_snapshot`
        activate,
        deactivate,
        reset,
        use,      ///< of a named set
        set,      ///< of a parameter
        command,  ///< whose results are the answer
        port,     ///< its last message: stamp [s], number of messages so far, and the value as text
        curves,   ///< the values of a name in the last seconds: `read_curves`
        connect,  ///< another port to this in-port
        disconnect,
        show,   ///< this name as text, as a console on that host shows it
        help,   ///< its help text
        names,  ///< the names of its children: those without a call, then methods and commands; names for plots if a
                ///< value says so
    };
    std::string host;
    std::string component;
    What what = What::look;
    /// The name of the set, parameter, command or port; else the path below the component: "config.speed_x".
    std::string name{};
    PlainData values{};  ///< the parameter's, the command's arguments, how many seconds, or the other port
};

}  // namespace nezumi

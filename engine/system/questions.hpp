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
        use,      ///< uses a named parameter set
        set,      ///< sets a parameter
        command,  ///< calls a command; the answer is its results
        port,     ///< the last message of a port: stamp [s], number of messages so far, and the value as text
        curves,   ///< the values of a name in the last seconds: `read_curves`
        connect,  ///< connects another port to this in-port
        disconnect,
        show,   ///< this name as text, as a console on that host shows it
        help,   ///< the help text of this name
        names,  ///< the names of the children: first values, then methods and commands; if `values` is not empty, the
                ///< names for plots
    };
    std::string host;
    std::string component;
    What what = What::look;
    /// The name of the set, parameter, command or port; else the path below the component: "config.speed_x".
    std::string name{};
    PlainData values{};  ///< the parameter's value, the arguments, the seconds, or the other port
};

}  // namespace nezumi

// Requests to a component of another host.
#pragma once

#include <cstdint>
#include <string>

#include "engine/values/plain_data.hpp"

namespace nezumi {

struct Question {
    enum class What : std::uint8_t {
        look,  ///< what is of this name, and its value: `read_snapshot`
        activate,
        deactivate,
        reset,
        use,      ///< of a named set
        set,      ///< of a parameter
        command,  ///< whose results are the answer
        port,     ///< what it carried last: its stamp [s], how many messages came, and the value as a text
        curves,   ///< what was carried in the last seconds under a name: `read_curves`
        connect,  ///< another port to this in-port
        disconnect,
        show,   ///< what is of this name as a text, as a console there shows it
        help,   ///< what there is to say of it
        names,  ///< what it has, those that are not called and those that are; of what is plotted if a value says so
    };
    std::string host;
    std::string component;
    What what = What::look;
    /// The name of the set, parameter, command or port; else the path below the component: "config.speed_x".
    std::string name{};
    PlainData values{};  ///< the parameter's, the command's arguments, how many seconds, or the other port
};

}  // namespace nezumi

// What a component of another host can be asked.
#pragma once

#include <cstdint>
#include <string>

#include "engine/values/plain_data.hpp"

namespace nezumi {

struct Question {
    enum class What : std::uint8_t {
        look,  ///< what it is and how it stands: a table
        activate,
        deactivate,
        reset,
        use,      ///< of a named set
        set,      ///< of a parameter
        command,  ///< whose results are the answer
    };
    std::string host;
    std::string component;
    What what = What::look;
    std::string name{};  ///< of the set, the parameter or the command
    PlainData values{};  ///< the parameter's, or the command's arguments
};

}  // namespace nezumi

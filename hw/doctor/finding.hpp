// One finding about a machine: what was found, and what to do about it.
#pragma once

#include <string>
#include <vector>

namespace nezumi::hw {

struct Finding {
    enum class State {
        good,
        note,   ///< for information; a robot works without it
        wrong,  ///< needs action
    };

    std::string check;  ///< what was examined: "driver"
    State state = State::good;
    std::string found;   ///< "rtmouse 3.3.2"
    std::string advice;  ///< what to do; "": nothing
};

using Findings = std::vector<Finding>;

}  // namespace nezumi::hw

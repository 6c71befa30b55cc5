// One thing that was looked at on a machine: what was found, and what a person can do about it.
#pragma once

#include <string>
#include <vector>

namespace nezumi::hw {

struct Finding {
    enum class State {
        good,
        note,   ///< good to know; a robot can do without
        wrong,  ///< something is to be done
    };

    std::string check;  ///< what was looked at: "driver"
    State state = State::good;
    std::string found;   ///< "rtmouse 3.3.2"
    std::string advice;  ///< what to do; "": nothing
};

using Findings = std::vector<Finding>;

}  // namespace nezumi::hw

// An RT system as RTSystemEditor keeps it in a file: components, their configuration, connections (RtsProfile, XML).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi::openrtm {

struct ProfiledComponent {
    std::string type;      ///< "RobotController"
    std::string instance;  ///< "RobotController0"
    std::string set;       ///< in use: "default"
    double rate = 0;       ///< [Hz] of its first execution context; 0: not said
    /// Configuration sets by name, with the texts of their values by parameter.
    std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> sets;
};

struct ProfiledEnd {
    std::string instance, port;  ///< "RobotController0", "out"
};

struct SystemProfile {
    std::string name;  ///< of the system; may be empty
    std::string doc;   ///< lines; may be empty
    std::vector<ProfiledComponent> components;
    std::vector<std::pair<ProfiledEnd, ProfiledEnd>> connections;  ///< of data ports, from and to
    std::vector<std::string> remarks;                              ///< what has no counterpart here, one line each
};

/// Reads the text of a profile; `shown` is the file's name in errors. Hostile texts are refused as by
/// `read_component_profile`.
Expected<SystemProfile> read_system_profile(std::string_view text, const std::string& shown);

}  // namespace nezumi::openrtm

// New systems, robots and scenarios as texts.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi::cli {

/// The arguments for a system.
struct NewSystem {
    std::string name;                      ///< of its file
    std::vector<std::string> robots;       ///< "NAME=MODEL"; none: a mouse
    std::vector<std::string> behaviors;    ///< "NAME=SCRIPT"
    std::vector<std::string> connections;  ///< "name.port=name.port"
};

/// Returns a system file. An error is only about the form of a name. Whether named files exist is checked when the
/// system is loaded.
Expected<std::string> system_text(const NewSystem& wanted);

/// Returns a robot file as a template: two wheels, three distance sensors and a touch sensor.
std::string robot_text(const std::string& name);

/// Returns a scenario for a system, loaded by `path`: its behaviours have no errors and its robots touch nothing.
std::string system_scenario_text(const std::string& name, const std::string& path, const SystemSpec& system);

}  // namespace nezumi::cli

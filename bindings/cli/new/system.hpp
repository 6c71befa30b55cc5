// New systems, robots and scenarios as texts.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi::cli {

/// What the command line says of a system.
struct NewSystem {
    std::string name;                      ///< of its file
    std::vector<std::string> robots;       ///< "NAME=MODEL"; none: a mouse
    std::vector<std::string> behaviors;    ///< "NAME=SCRIPT"
    std::vector<std::string> connections;  ///< "name.port=name.port"
};

/// A system file; an error is about the form of a word alone: what the words name is for whoever loads it.
Expected<std::string> system_text(const NewSystem& wanted);

/// A robot file: a small one with two wheels, three distance sensors and a touch sensor, to be changed.
std::string robot_text(const std::string& name);

/// A scenario for a system, which is loaded by `path`: that its behaviours stay well and its robots touch nothing.
std::string system_scenario_text(const std::string& name, const std::string& path, const SystemSpec& system);

}  // namespace nezumi::cli

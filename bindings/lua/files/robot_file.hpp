// Reads robot files: `return robot_model { ... }` as a robot's description.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/project/project.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// Reads a robot file. Tables (`table = "x.csv"`) are looked up beside it. Errors say file and line. `files`, if given,
/// gets every file that was read, as the project shows them.
Expected<RobotSpec> read_robot_file(const std::filesystem::path& path, const Project& project,
                                    std::vector<std::string>* files = nullptr);

/// The same from text; `shown` is the file's name in errors, and its folder is where tables are looked up.
Expected<RobotSpec> read_robot_text(std::string_view text, const std::string& shown, const Project& project,
                                    std::vector<std::string>* files = nullptr);

/// All that is wrong with a robot file; empty when it can be read. For editors: every unknown global is one error, of
/// anything else the first.
std::vector<Error> check_robot_text(std::string_view text, const std::string& shown, const Project& project);

}  // namespace nezumi

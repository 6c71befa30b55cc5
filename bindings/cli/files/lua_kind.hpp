// Determines the kind of a Lua file.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::cli {

enum class LuaKind {
    behavior,
    module,         ///< a module for behaviours: returns a value and declares nothing
    system_module,  ///< a module that uses functions of system files
    system,
    robot,
    calibration,  ///< `ROBOT.calibration.lua`
    scenario,     ///< `*_test.lua`
    message,      ///< defines a message type
    environment,  ///< of a learning program
    definitions,  ///< `---@meta`: for the language server, never run
};

/// Decides by the file's name, then by the globals that its text uses, then by its folder. A text that is not valid Lua
/// gets an arbitrary kind: it is an error for every kind.
LuaKind kind_of_file(const std::filesystem::path& path, std::string_view text);

/// Returns the error of a system file, with an explanation if an unknown global belongs to another kind of file.
Error explain_system_error(Error error);

/// The name of the kind in `nezumi list`: "systems", "robots", "behaviors", "messages", "modules", "scenarios",
/// "environments"; "" for other kinds.
std::string_view kind_name(LuaKind kind);

}  // namespace nezumi::cli

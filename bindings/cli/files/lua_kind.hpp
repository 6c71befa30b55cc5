// Determines the kind of a Lua file from its words and its folder.
#pragma once

#include <filesystem>
#include <string_view>

#include "engine/base/error.hpp"

namespace nezumi::cli {

enum class LuaKind {
    behavior,
    module,         ///< of behaviours: returns a value and declares nothing
    system_module,  ///< a module that uses the words of system files
    system,
    robot,
    calibration,  ///< `ROBOT.calibration.lua`
    scenario,     ///< `*_test.lua`
    message,      ///< defines a message type
    environment,  ///< of a learning program
    definitions,  ///< `---@meta`: for the language server, never run
};

/// Decides by the file's name, then by the words in its text, then by its folder. A text that is not Lua gets an
/// arbitrary kind: it is wrong as any kind.
LuaKind kind_of_file(const std::filesystem::path& path, std::string_view text);

/// Returns the error of a system file, with an explanation if an unknown global belongs to another kind of file.
Error explain_system_error(Error error);

/// As `nezumi list` names these files: "systems", "robots", "behaviors", "messages", "modules", "scenarios",
/// "environments"; "" for other kinds.
std::string_view kind_name(LuaKind kind);

}  // namespace nezumi::cli

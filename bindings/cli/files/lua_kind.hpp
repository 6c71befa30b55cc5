// What a Lua file is for, told by its words and its place.
#pragma once

#include <filesystem>
#include <string_view>

namespace nezumi::cli {

enum class LuaKind {
    behavior,
    module,         ///< of behaviours: returns something and declares nothing
    system_module,  ///< a module that uses the words of system files
    system,
    robot,
    calibration,  ///< `ROBOT.calibration.lua`
    scenario,     ///< `*_test.lua`
    definitions,  ///< `---@meta`: for the language server, nothing that runs
};

/// Decides by the file's name, then by the words that its text uses, then by its folder. A text that is no Lua gets
/// some kind: it is wrong as any.
LuaKind kind_of_file(const std::filesystem::path& path, std::string_view text);

}  // namespace nezumi::cli

// Annotations for the Lua language server (LuaLS): completion and type errors for behaviours, systems and scenarios.
#pragma once

#include <string>

namespace nezumi {

/// A definition file (`---@meta`): the message types from their descriptions, one class per type and direction, and the
/// words of behaviours, system files, robot files and scenarios.
std::string annotations();

namespace detail {
/// The parts that are not made from the message types.
extern const char* const behavior_annotations;
extern const char* const system_annotations;
extern const char* const scenario_annotations;
}  // namespace detail

/// A plugin for the language server that gives `config` in each file the parameters which that file declares.
extern const char* const annotations_plugin;

}  // namespace nezumi

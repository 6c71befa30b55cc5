// Annotations for the Lua language server (LuaLS): completion and type errors for behaviours, systems and scenarios.
#pragma once

#include <string>
#include <vector>

#include "engine/records/record_shape.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// A definition file (`---@meta`): the message types from their descriptions, one class per type and direction, and the
/// words of behaviours, system files, robot files and scenarios. `more` are structures that these words take and that
/// other libraries describe: the options of scenarios. `peers`: words of system files that describe peers.
std::string annotations(const std::vector<RecordShape>& more, const PeerWords& peers,
                        const std::vector<const MessageType*>& defined = {});

namespace detail {
/// The parts that do not depend on the message types.
extern const char* const behavior_annotations;
extern const char* const scenario_annotations;
}  // namespace detail

/// A plugin for the language server: in each file, `config` has the parameters that the file declares.
extern const char* const annotations_plugin;

}  // namespace nezumi

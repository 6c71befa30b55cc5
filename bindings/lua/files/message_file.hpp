// Reads Lua files that define a message: `return message "Obstacle" { { "distance", "double", unit = "m" } }`.
#pragma once

#include "engine/messages/definition.hpp"
#include "engine/project/project.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// Errors say file and line. The name is that of the file: `light_sensors.lua` defines `LightSensors`.
Expected<MessageDefinition> read_message_file(const SourceText& source, const Project& project);

}  // namespace nezumi

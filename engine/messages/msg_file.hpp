// Reads files of ROS that define a message: NAME.msg.
#pragma once

#include <string_view>

#include "engine/messages/definition.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// Reads the definition of a message in this package ("" for none). Comments become the documentation of the message
/// and its fields. The fields may have infinite numbers and NaN. Errors have file and line.
Expected<MessageDefinition> read_msg(const SourceText& source, std::string_view package);

}  // namespace nezumi

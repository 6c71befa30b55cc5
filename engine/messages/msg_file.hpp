// Reads files of ROS that define a message: NAME.msg.
#pragma once

#include <string_view>

#include "engine/messages/definition.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// A message of this package ("" for none). Comments become what it and its fields mean; numbers may be infinite or
/// none. Errors say file and line.
Expected<MessageDefinition> read_msg(const SourceText& source, std::string_view package);

}  // namespace nezumi

// Message types as readable text: fields, units and limits.
#pragma once

#include <string>

#include "engine/ports/payload.hpp"

namespace nezumi {

/// One message type: a line with its name and meaning, then a line for each field.
std::string type_table(const MessageInfo& message);

/// All message types, and notes about all of them.
std::string type_table();

}  // namespace nezumi

// Message types as readable text: fields, units and limits.
#pragma once

#include <string>
#include <vector>

#include "engine/ports/payload.hpp"

namespace nezumi {

/// One message type: a line with its name and meaning, then a line for each field.
std::string type_table(const MessageType& message);

/// All compiled message types, these additional ones, and the rules for all of them.
std::string type_table(const std::vector<const MessageType*>& defined = {});

}  // namespace nezumi

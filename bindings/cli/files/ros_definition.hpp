// Message types made from the definitions in a recording.
#pragma once

#include "bindings/record/mcap.hpp"
#include "engine/base/error.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi::cli {

/// The type that a schema defines: the text of a .msg file, then for each message in it a line of 80 times '=', a line
/// "MSG: geometry_msgs/Point", and its text. The type's name has the form "my_msgs/Obstacle". The error has no
/// location.
Expected<const MessageType*> type_of_definition(const record::Schema& schema);

}  // namespace nezumi::cli

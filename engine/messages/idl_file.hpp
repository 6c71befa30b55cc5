// Reads OMG IDL files that define messages, one for each structure.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "engine/messages/definition.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// The kind of a field with wide characters. No message can have such a field.
inline constexpr std::string_view wide_text = "wstring";

/// Finds the file of an `#include`; the error says why there is none. For a file that was already included, the result
/// may have no text.
using IdlIncluder = std::function<Expected<SourceText>(std::string_view name, const SourceText& from)>;

/// Reads the structures of a file and of the files that it includes, in order. Structures have names like
/// "RTC/TimedOctet", also as types of fields. Comments become the documentation of structures and fields. Errors have
/// file and line; unions, value types and other unsupported parts are errors too.
Expected<std::vector<MessageDefinition>> read_idl(const SourceText& source, const IdlIncluder& include);

/// Converts a structure to the message of a port. A first field `tm` of type `Time` becomes the stamp of the message,
/// not a field. If then only one field `data` is left, its value is the payload.
MessageDefinition without_stamp(MessageDefinition message);

}  // namespace nezumi

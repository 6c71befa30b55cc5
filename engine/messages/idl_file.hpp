// Reads files in OMG IDL that define messages: each of their structures is one.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "engine/messages/definition.hpp"
#include "engine/project/script_source.hpp"

namespace nezumi {

/// The kind of a field of wide characters, which no message has.
inline constexpr std::string_view wide_text = "wstring";

/// Finds the file that an `#include` names, or says why there is none. A file that was included already need not be
/// found again: what it gives then has no text.
using IdlIncluder = std::function<Expected<SourceText>(std::string_view name, const SourceText& from)>;

/// The structures of a file and of those that it includes, in their order, by names as "RTC/TimedOctet". Their fields
/// name each other so. Comments become what structures and fields mean. Errors say file and line: also for unions,
/// value types and what else is not read.
Expected<std::vector<MessageDefinition>> read_idl(const SourceText& source, const IdlIncluder& include);

/// As a message of a port: a first field `tm` of the type `Time` is its stamp, and no field of it. What then has one
/// field, `data`, is that value itself.
MessageDefinition without_stamp(MessageDefinition message);

}  // namespace nezumi

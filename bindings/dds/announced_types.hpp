// The announcement of message types that are defined in files, and the comparison with another host's definitions.
#pragma once

#include <string>
#include <vector>

#include "bindings/dds/wire.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi::dds {

/// Limits on the types in one announcement.
inline constexpr std::size_t most_types = 256, most_fields = 4096;

/// Returns the types to announce, each once. Compiled types and types that exceed the limits are left out.
std::vector<AnnouncedType> announced_types(const std::vector<const MessageType*>& types);

/// Explains how another host's definition of a type differs from this host's: "field 'distance' is finite number [m] in
/// PORT, and finite number [mm] in OTHER_PORT". "" if the two definitions have different names.
std::string explain_difference(const MessageType& ours, const std::string& port, const AnnouncedType& theirs,
                               const std::string& other_port);

}  // namespace nezumi::dds

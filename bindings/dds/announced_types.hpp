// Message types that files define, as hosts tell each other about them.
#pragma once

#include <string>
#include <vector>

#include "bindings/dds/wire.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi::dds {

/// Limits on the types in one announcement.
inline constexpr std::size_t most_types = 256, most_fields = 4096;

/// What to announce of these types: each once, without the compiled ones and without those that exceed the limits.
std::vector<AnnouncedType> announced_types(const std::vector<const MessageType*>& types);

/// In which field another host's definition of a type differs from this host's: "field 'distance' is finite number [m]
/// in PORT, and finite number [mm] in OTHER_PORT". "" if that is not a definition of the same name or no difference is
/// known.
std::string explain_difference(const MessageType& ours, const std::string& port, const AnnouncedType& theirs,
                               const std::string& other_port);

}  // namespace nezumi::dds

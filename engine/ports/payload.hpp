// Payloads whose message type is only known at run time, as values of that type.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "engine/ports/messages.hpp"
#include "engine/values/value.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {

/// A message type at run time.
struct MessageInfo {
    std::string_view name;
    std::string_view doc;
    const Type* payload;
};

/// All message types, in the order of `message_types`.
std::span<const MessageInfo> message_infos();

/// A payload of the message type at this index of `message_types`, as it is by itself.
inline Value make_payload(std::size_t index) { return Value(*message_infos()[index].payload); }

/// The place in `message_types` of the message type that carries such a value; their number where there is none.
std::size_t message_index(const Type& payload);
/// The name of that message type, or "no message".
std::string_view message_name(const Type& payload);

}  // namespace nezumi

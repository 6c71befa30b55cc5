// Message types at run time: those that are compiled in, and those that files define.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "engine/ports/messages.hpp"
#include "engine/values/value.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {

/// A message type: what ports carry. There is one of each, so two are equal when their addresses are.
struct MessageType {
    std::string name;
    std::string doc;
    const Type* payload = nullptr;
    /// In `compiled_messages`; their number for what a file defines.
    std::size_t place = compiled_message_count;
    std::string file{};  ///< that defines it, as messages show it
    std::string ros{};   ///< its name in ROS 2, as "my_msgs/msg/Obstacle"; "" for none
    std::string rtm{};   ///< its name in OpenRTM, as "IDL:Seen/Obstacle:1.0"; "" for none
    std::map<std::string, Value, std::less<>> constants{};

    bool is_compiled() const { return place < compiled_message_count; }
};

/// The message types that are compiled in, in the order of `compiled_messages`.
std::span<const MessageType> compiled_message_types();
/// Their names.
std::span<const std::string_view> compiled_message_names();

/// The message type of payload T; of `Value`, which holds the payloads of all that files define, null.
template <class T>
const MessageType* message_of() {
    if constexpr (Payload<T>) {
        return &compiled_message_types()[detail::place_of_payload<T>()];
    } else {
        static_assert(std::is_same_v<T, Value>);
        return nullptr;
    }
}

/// A payload of this message type, as it is by itself.
inline Value make_payload(const MessageType* type) { return Value(*type->payload); }

/// The message type that carries such a value; null where there is none.
const MessageType* message_of(const Type& payload);
/// The name of that message type, or "no message".
std::string_view message_name(const Type& payload);

/// Calls `make.template operator()<T>()` for the payload of a message type: T is a compiled one's structure, or `Value`
/// for what a file defines. All calls must return the same type.
template <class Make>
decltype(auto) with_payload_type(const MessageType& type, Make&& make) {
    using Result = decltype(make.template operator()<bool>());
    using Call = Result (*)(Make&);
    static constexpr auto table = []<std::size_t... I>(std::index_sequence<I...>) {
        return std::array<Call, compiled_message_count + 1>{
            [](Make& m) -> Result { return m.template operator()<detail::PayloadAt<I>>(); }...,
            [](Make& m) -> Result { return m.template operator()<Value>(); }};
    }
    (std::make_index_sequence<compiled_message_count>{});
    return table[type.place](make);
}

}  // namespace nezumi

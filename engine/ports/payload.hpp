// Message types at run time: the compiled ones, and those defined by files.
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

/// A message type of ports. Each exists once, so equal types have equal addresses.
struct MessageType {
    std::string name;
    std::string doc;
    const Type* payload = nullptr;
    /// The index in `compiled_messages`; for a type from a file, the number of compiled messages.
    std::size_t place = compiled_message_count;
    std::string file{};  ///< the file that defines the type, as error messages show it; "" for none
    std::string ros{};   ///< name in ROS 2, such as "my_msgs/msg/Obstacle"; "" for none
    std::string rtm{};   ///< name in OpenRTM, such as "IDL:Seen/Obstacle:1.0"; "" for none
    /// Whether the type of OpenRTM begins with the stamp, `Time tm`.
    bool has_rtm_stamp = true;
    std::map<std::string, Value, std::less<>> constants{};

    bool is_compiled() const { return place < compiled_message_count; }
};

/// The message types that are compiled in, in the order of `compiled_messages`.
std::span<const MessageType> compiled_message_types();
/// The names of these types.
std::span<const std::string_view> compiled_message_names();

/// The message type of payload T; null for `Value`, which holds the payloads of all types from files.
template <class T>
const MessageType* message_of() {
    if constexpr (Payload<T>) {
        return &compiled_message_types()[detail::place_of_payload<T>()];
    } else {
        static_assert(std::is_same_v<T, Value>);
        return nullptr;
    }
}

/// The default payload of this message type.
inline Value make_payload(const MessageType* type) { return Value(*type->payload); }

/// The message type with this payload; null if there is none.
const MessageType* message_of(const Type& payload);
/// The name of the message type with this payload, or "no message".
std::string_view message_name(const Type& payload);

/// Calls `make.template operator()<T>()` for the payload of a message type: T is the structure of a compiled type, or
/// `Value` for a type from a file. All calls must return the same type.
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

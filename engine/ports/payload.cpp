// The tables of the payloads, by the index of their message type.
#include "engine/ports/payload.hpp"

#include <algorithm>

namespace nezumi {

std::span<const MessageType> compiled_message_types() {
    static const auto all = []<std::size_t... I>(std::index_sequence<I...>) {
        return std::array{MessageType{.name = std::string(std::get<I>(compiled_messages).name),
                                      .doc = std::string(std::get<I>(compiled_messages).doc),
                                      .payload = &type_of<detail::PayloadAt<I>>(),
                                      .place = I}...};
    }
    (std::make_index_sequence<compiled_message_count>{});
    return all;
}

std::span<const std::string_view> compiled_message_names() {
    static constexpr auto all =
        std::apply([](const auto&... type) { return std::array{type.name...}; }, compiled_messages);
    return all;
}

const MessageType* message_of(const Type& payload) {
    if (payload.message != nullptr) return payload.message;
    const auto all = compiled_message_types();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const MessageType& each) { return each.payload == &payload; });
    return found != all.end() ? &*found : nullptr;
}

std::string_view message_name(const Type& payload) {
    const MessageType* type = message_of(payload);
    return type != nullptr ? std::string_view(type->name) : "no message";
}

}  // namespace nezumi

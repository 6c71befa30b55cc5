// The tables of the payloads, by the place of their message type.
#include "engine/ports/payload.hpp"

#include <algorithm>

namespace nezumi {

std::span<const MessageInfo> message_infos() {
    static const auto all = std::apply(
        []<class... T>(const MessageType<T>&... type) {
            return std::array{MessageInfo{type.name, type.doc, &type_of<T>()}...};
        },
        message_types);
    return all;
}

std::size_t message_index(const Type& payload) {
    const auto all = message_infos();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const MessageInfo& each) { return each.payload == &payload; });
    return static_cast<std::size_t>(found - all.begin());
}

std::string_view message_name(const Type& payload) {
    const std::size_t index = message_index(payload);
    return index < message_infos().size() ? message_infos()[index].name : "no message";
}

}  // namespace nezumi

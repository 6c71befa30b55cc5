// Functions that read members, for the tables of members.
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "engine/system/perform.hpp"
#include "engine/tree/member.hpp"

namespace nezumi::reads {

using Read = Expected<NodeValue>;

template <class T>
NodeValue to_node_value(T&& value) {
    if constexpr (std::is_same_v<std::remove_cvref_t<T>, NodeValue>) {
        return std::forward<T>(value);
    } else {
        return Value{std::forward<T>(value)};
    }
}

template <auto read>
Read of_node(const TreeNode& node, const PlainLimit& /*limit*/) {
    return to_node_value(read(node));
}
template <auto read>
Read of_component(const TreeNode& node, const PlainLimit& /*limit*/) {
    return to_node_value(read(*node.component()));
}
template <auto read>
Read of_robot(const TreeNode& node, const PlainLimit& /*limit*/) {
    return to_node_value(read(*node.robot()));
}
template <auto read>
Read of_seen(const TreeNode& node, const PlainLimit& /*limit*/) {
    const auto seen = seen_robot(node.system(), *node.component());
    return seen ? Read(to_node_value(read(*seen))) : Unexpected(seen.error());
}
template <auto read>
Read of_port(const TreeNode& node, const PlainLimit& /*limit*/) {
    return to_node_value(read(*node.port()));
}

/// The text as a value; nothing for an empty text.
inline NodeValue text_if_any(const std::string& text) { return text.empty() ? NodeValue{} : NodeValue{Value{text}}; }

}  // namespace nezumi::reads

// The members of every component (`X.status`, `X:reset()`) and of every port, each described once: name, meaning, and
// how it is read.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/tree/node.hpp"

namespace nezumi {

struct MemberInfo {
    std::string_view name;
    std::string_view type{};  ///< as in annotations of Lua
    bool robot = false;       ///< whether only robots have it
    bool called = false;      ///< a method: `X:name(...)`
    bool yields = false;      ///< true: a port may have the name, and then `X.name` is the port
    int most = 0;             ///< maximum number of arguments of a method
    std::string usage{};      ///< "(pose)"
    std::string_view doc{};   ///< documentation
    /// For a table, which is only a copy: the advice in the error if a user writes to it.
    std::string_view instead{};
    TreeNode::Kind kind = TreeNode::Kind::value;
    /// The function that reads the member; null for methods, and for members that have only children.
    Expected<NodeValue> (*value)(const TreeNode& node, const PlainLimit& limit) = nullptr;
};

/// All members of components, sorted by name.
std::span<const MemberInfo> component_members();
/// All members of ports.
std::span<const MemberInfo> port_members();

/// nullptr if there is none with this name.
const MemberInfo* find_member(std::span<const MemberInfo> members, std::string_view name);

/// Names that ports, parameters and commands of scripts can't have: members of components that do not yield. Sorted.
const std::vector<std::string_view>& names_taken_by_components();
/// Names that ports of robots can't have. Sorted.
const std::vector<std::string_view>& names_taken_by_robots();

/// The age of the port's latest message at the next tick [s]; infinity before the first message.
double port_age(const System& system, const Port& port);
/// Whether the port got no message for the time `OutPortBase::stale_after` of the sender, or is an in-port without
/// connection.
bool is_stale(const System& system, const Port& port);
/// "", "held", "dropped", "frozen".
std::string_view to_text(Override override);

/// The true state of a robot for display: tiny values, such as 2.4e-17 m, are rounding errors and become zero.
Truth seen_truth(const World& world, RobotId robot);

}  // namespace nezumi

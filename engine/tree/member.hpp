// The members that every component (`X.status`, `X:reset()`) and every port has, each stated once: what it is called,
// what it means and how it is read.
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
    std::string_view type{};  ///< as annotations of Lua spell it
    bool robot = false;       ///< of robots only
    bool called = false;      ///< `X:name(...)`
    bool yields = false;      ///< where a port has the name, `X.name` is the port; else no port can have it
    int most = 0;             ///< arguments at most, where it is called
    std::string usage{};      ///< "(pose)"
    std::string_view doc{};   ///< what it is, for people
    /// Of a table, which is a copy: what to do rather than write to it.
    std::string_view instead{};
    TreeNode::Kind kind = TreeNode::Kind::value;
    /// What it holds now; null for what only has children, and for what is called.
    Expected<NodeValue> (*value)(const TreeNode& node, const PlainLimit& limit) = nullptr;
};

/// All members of components, sorted by name.
std::span<const MemberInfo> component_members();
/// All of ports.
std::span<const MemberInfo> port_members();

/// nullptr when there is none of this name.
const MemberInfo* find_member(std::span<const MemberInfo> members, std::string_view name);

/// What ports, parameters and commands of scripts can't be called: the members of components that do not yield. Sorted.
const std::vector<std::string_view>& names_taken_by_components();
/// The same for the ports of robots.
const std::vector<std::string_view>& names_taken_by_robots();

/// [s] since the port's message, as of the tick that comes next; infinity before any.
double port_age(const System& system, const Port& port);
/// Nothing came through for `OutPortBase::stale_after` of its sender; of an in-port also when nothing is connected.
bool is_stale(const System& system, const Port& port);
/// "", "held", "dropped", "frozen".
std::string_view to_text(Override override);

/// The truth about a robot for those who look at it: what the solver's rounding leaves of a zero, as 2.4e-17 m, is
/// zero.
Truth seen_truth(const World& world, RobotId robot);

}  // namespace nezumi

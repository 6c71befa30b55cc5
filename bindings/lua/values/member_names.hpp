// The names of what a component (`X.status`, `X:reset()`) and a port have as seen from outside: one list of each for
// all who need them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// One member of the object model.
struct MemberName {
    std::string_view name;
    std::string_view type{};  ///< Lua's, as editors know it
    bool robot = false;       ///< of robots only
    bool called = false;      ///< `X:name(...)`
    bool yields = false;      ///< where a port has the name, `X.name` is the port; else no port can have it
    int most = 0;             ///< arguments at most, where it is called
    std::string usage{};      ///< "(pose)"
    std::string_view doc{};   ///< what it is, for people
    /// Of a table, which is a copy: what to do rather than write to it.
    std::string_view instead{};
};

/// All members of components, sorted by name.
std::span<const MemberName> member_names();
/// All of ports.
std::span<const MemberName> port_member_names();

/// What ports, parameters and commands of scripts can't be called: the members that do not yield. Sorted.
const std::vector<std::string_view>& component_members();
/// The same for the ports of robots.
const std::vector<std::string_view>& robot_members();

}  // namespace nezumi

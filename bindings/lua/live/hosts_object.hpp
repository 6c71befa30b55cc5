// What a system knows of other hosts, as `hosts` of the console shows it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/live/objects.hpp"
#include "engine/base/error.hpp"
#include "engine/system/network.hpp"
#include "engine/system/questions.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// What a component of another host can be told to do, beside its commands.
struct RemoteMethod {
    std::string_view name;
    Question::What what;
};
inline constexpr std::array remote_methods{
    RemoteMethod{"activate", Question::What::activate}, RemoteMethod{"deactivate", Question::What::deactivate},
    RemoteMethod{"reset", Question::What::reset}, RemoteMethod{"use", Question::What::use}};
/// What reading one gives, beside its parameters.
inline constexpr std::array<std::string_view, 7> remote_members{"error",  "rate", "set",    "sets",
                                                                "status", "type", "version"};

/// Those of a system that is on no network are none.
std::vector<Host> hosts_of(const System& system);
/// The error names the nearest.
Expected<Host> find_host(const System& system, std::string_view name);
/// Sorted.
std::vector<std::string> component_names(const Host& host);
/// The ports that "host/name" offers; their names are without that.
std::vector<OfferedPort> ports_of(const System& system, std::string_view path);

/// Pushes `hosts`. May raise a Lua error.
void push_hosts(lua_State* L, Objects& objects, RunningSystem& live);

// What could stand behind a dot, or a colon where it is `called`. Sorted by who asks.

/// `hosts.`
std::vector<std::string> host_names(const System& system);
/// `hosts.ev3.` for "ev3", `hosts.ev3.vehicle.` for "ev3/vehicle".
std::vector<std::string> host_members(const System& system, std::string_view path, bool called);
/// The ports that other hosts offer in a direction, of the type of `like` if that is given: "ev3/vehicle.current_vel".
std::vector<std::string> offered_ports(const System& system, Direction direction, const Port* like);

}  // namespace nezumi

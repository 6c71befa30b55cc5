// The object `hosts` of the console: other hosts and their components.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/live/objects.hpp"
#include "engine/base/error.hpp"
#include "engine/system/network.hpp"
#include "engine/system/questions.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// The other hosts; none if the system has no network.
std::vector<Host> hosts_of(const System& system);
/// The error names the nearest host.
Expected<Host> find_host(const System& system, std::string_view name);
/// The names of the host's components, sorted.
std::vector<std::string> component_names(const Host& host);
/// The ports that the component `path` ("host/name") offers; their names are without this prefix.
std::vector<OfferedPort> ports_of(const System& system, std::string_view path);
/// Checks that another host offers the port "host/name.port". The error names the nearest.
Expected<void> check_offered(const System& system, std::string_view path);

/// Sends a question to another host, and waits for the answer while ticks go on. The network limits the waiting time.
Expected<PlainData> ask_host(const Objects& objects, const RunningSystem& live, const Question& question);

struct ObjectRef;
/// The text that a host returns about one of its objects, made safe for a terminal: `show` or `help`.
Expected<std::string> text_of_host(const Objects& objects, const ObjectRef& ref, Question::What what);

/// "host/name.port" at `index`: such a text, or the object of a port. Nothing for anything else. Raises nothing.
std::optional<std::string> port_of_host(lua_State* L, int index);
/// The full name of the thing at `path` (".ev3.vehicle.current_vel.vx") from an object of hosts at `index`:
/// "ev3/vehicle.current_vel.vx".
std::optional<std::string> path_of_host(lua_State* L, int index, std::string_view path);

/// Pushes `hosts`. May raise a Lua error.
void push_hosts(lua_State* L, Objects& objects, RunningSystem& live);

// Candidates for completion. The caller sorts them.

/// Candidates after `hosts.`: the names of the other hosts.
std::vector<std::string> host_names(const System& system);
/// The ports that other hosts offer, of this type if one is given: "ev3/vehicle.current_vel".
std::vector<std::string> offered_ports(const System& system, bool in, bool out, std::string_view type = "");
/// The type of the port "host/name.port"; "" if no host offers it.
std::string offered_type(const System& system, std::string_view path);

}  // namespace nezumi

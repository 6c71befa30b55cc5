// Commands that connect and disconnect ports.

#include "bindings/console/console_commands.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {
namespace {

// The path "name.port" of a port of this system. Names of other ports ("rtm:NAME.port", "host/name.port") stay as they
// are: the act that connects them finds their ports.
Expected<std::string> port(Session::Parts& parts, const Arguments& arguments, int index) {
    if (index > arguments.count()) return failure("expected a port or \"name.port\", got nothing");
    if (peer_named(arguments, index)) return arguments.text(index, "a port");
    if (auto path = port_of_host(arguments.lua, arguments.index(index))) return *path;
    return parts.at_system([&]() -> Expected<std::string> {
        const auto at = parts.objects->to_port(arguments.lua, index);
        if (!at) return Unexpected(at.error());
        return at->path();
    });
}

bool is_of_hosts(std::string_view from, std::string_view to) { return is_remote(from) && is_remote(to); }

// For two ports of other hosts: asks the host of the receiving port to make or end the connection.
Expected<CommandEnd> ask_there(const Session::Parts& parts, Question::What what, const std::string& from,
                               const std::string& to) {
    std::string_view port = without_host(to);
    const std::string component(take_step(port));
    return done(ask_host(*parts.objects, parts.live,
                         {.host = std::string(host_of(to)),
                          .component = component,
                          .what = what,
                          .name = std::string(port),
                          .values = {.values = {from}, .tables = {}}}));
}

}  // namespace

Expected<CommandEnd> command_connect(Session::Parts& parts, const Arguments& arguments) {
    const auto from = port(parts, arguments, 1);
    if (!from) return Unexpected(from.error());
    const auto to = port(parts, arguments, 2);
    if (!to) return Unexpected(to.error());
    if (is_of_hosts(*from, *to)) return ask_there(parts, Question::What::connect, *from, *to);
    return done(parts.at_system([&] { return parts.act(Connect{*from, *to}); }));
}

Expected<CommandEnd> command_disconnect(Session::Parts& parts, const Arguments& arguments) {
    const auto first = port(parts, arguments, 1);
    if (!first) return Unexpected(first.error());
    const auto second = arguments.has(2) ? port(parts, arguments, 2) : Expected<std::string>();
    if (!second) return Unexpected(second.error());
    if (is_of_hosts(*first, *second)) return ask_there(parts, Question::What::disconnect, *first, *second);
    return done(parts.at_system([&] { return parts.act(Disconnect{*first, *second}); }));
}

}  // namespace nezumi

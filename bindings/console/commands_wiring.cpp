// Commands that connect and disconnect ports.
#include <fmt/format.h>

#include "bindings/console/console_commands.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {
namespace {

// "name.port" of a port of the system; of another program's "rtm:NAME.port", or another host's "host/name.port", as it
// is: connecting finds it.
Expected<std::string> port(const Session::Parts& parts, const Arguments& arguments, int index) {
    if (index > arguments.count()) return failure("expected a port or \"name.port\", got nothing");
    if (peer_named(arguments, index)) return arguments.text(index, "a port");
    if (auto text = arguments.text(index, "a port"); text && is_remote(*text)) return text;
    const auto at = parts.objects->to_port(arguments.lua, index);
    if (!at) return Unexpected(at.error());
    return at->path();
}

}  // namespace

Expected<CommandEnd> command_connect(Session::Parts& parts, const Arguments& arguments) {
    const auto from = port(parts, arguments, 1);
    if (!from) return Unexpected(from.error());
    const auto to = port(parts, arguments, 2);
    if (!to) return Unexpected(to.error());
    return done(parts.act(Connect{*from, *to}));
}

Expected<CommandEnd> command_disconnect(Session::Parts& parts, const Arguments& arguments) {
    const auto first = port(parts, arguments, 1);
    if (!first) return Unexpected(first.error());
    if (!arguments.has(2)) return done(parts.act(Disconnect{*first, ""}));
    const auto second = port(parts, arguments, 2);
    if (!second) return Unexpected(second.error());
    return done(parts.act(Disconnect{*first, *second}));
}

}  // namespace nezumi

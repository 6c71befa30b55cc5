// Commands that follow a port over time, or move something: watches, the stick, markers.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bindings/console/console_commands.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/robot_acts.hpp"

namespace nezumi {
namespace {

Expected<std::string> path(const Session::Parts& parts, const Arguments& arguments) {
    if (arguments.count() < 1) return failure("expected a port or \"name.port\", got nothing");
    const auto port = parts.objects->to_port(arguments.lua, 1);
    if (!port) return Unexpected(port.error());
    return port->path();
}

}  // namespace

Expected<CommandEnd> command_watch(Session::Parts& parts, const Arguments& arguments) {
    auto port = path(parts, arguments);
    if (auto theirs = port_of_host(arguments.lua, 1); !port && theirs) {
        if (auto offered = check_offered(parts.live.system(), *theirs); !offered) return Unexpected(offered.error());
        port = std::move(*theirs);
    }
    if (!port) return Unexpected(port.error());
    const auto same = [&](const PortWatch& watch) { return watch.path == *port; };
    if (std::none_of(parts.watches.begin(), parts.watches.end(), same)) parts.watches.push_back({.path = *port});
    return CommandEnd::done;
}

Expected<CommandEnd> command_unwatch(Session::Parts& parts, const Arguments& arguments) {
    if (!arguments.has(1)) {
        parts.watches.clear();
        parts.plots.clear();
        parts.changes.clear();
        parts.breaks.clear();
        watch_lines(parts);
        return CommandEnd::done;
    }
    if (arguments.kind(1) == "string") {
        const auto name = *arguments.text(1, "a port");
        const auto is_it = [&](const LineBreak& each) {
            return name == fmt::format("{}:{}", each.place.file, each.place.line);
        };
        if (std::erase_if(parts.breaks, is_it) > 0) return watch_lines(parts), CommandEnd::done;
    }
    if (const auto value = name_of_value(parts, arguments, 1)) {
        if (std::erase_if(parts.changes, [&](const ChangeWatch& each) { return each.name == *value; }) > 0)
            return CommandEnd::done;
    }
    // A port that no longer exists can only be named by its text.
    auto port = path(parts, arguments);
    if (auto theirs = port_of_host(arguments.lua, 1); !port && theirs) port = std::move(*theirs);
    if (!port) port = arguments.text(1, "a port");
    if (!port) return Unexpected(port.error());
    if (std::erase_if(parts.watches, [&](const PortWatch& watch) { return watch.path == *port; }) == 0)
        return failure(fmt::format("{} is not watched", *port));
    return CommandEnd::done;
}

Expected<CommandEnd> command_explain(Session::Parts& parts, const Arguments& arguments) {
    if (arguments.count() < 1) return failure("expected a behaviour, as in explain(controller), got nothing");
    const auto at = parts.objects->to_component(arguments.lua, 1);
    if (!at) return Unexpected(at.error());
    const std::string name = at->component->name();
    bool has_failed = false;
    const auto asked = parts.at_system([&]() -> std::optional<Expected<void>> {
        const Component* const component = std::as_const(parts.live).system().find(name);
        has_failed = component != nullptr && component->state() == LifeState::error && !parts.is_hardware;
        if (has_failed) return Expected<void>();
        const auto trace = parts.live.explain_next(name);
        if (!trace) return Unexpected(trace.error());
        parts.explained.push_back({name, *trace, parts.live.generation()});
        if (parts.clock.is_paused()) parts.show("time is paused: step() lets it execute");
        return Expected<void>();
    });
    if (!asked) return failure("interrupted");
    if (!*asked) return Unexpected(asked->error());
    return has_failed ? explain_failure(parts, name) : CommandEnd::done;
}

Expected<CommandEnd> command_drive(Session::Parts& parts, const Arguments& arguments) {
    if (!parts.options.output.take_keys) return failure("this needs a terminal, because it reads keys");
    Expected<std::string> what = path(parts, arguments);
    if (!what) {
        const auto component = arguments.count() < 1 ? Expected<ComponentAt>(failure("drive \"stick\""))
                                                     : parts.objects->to_component(arguments.lua, 1);
        if (component) {
            what = component->component->name();
        } else if (arguments.count() < 1) {
            return failure("expected a component or a port to drive, as in drive \"stick\", got nothing");
        } else {
            return Unexpected(what.error().message.find("is not a port") != std::string::npos ? component.error()
                                                                                              : what.error());
        }
    }
    if (auto ok = parts.drive.begin(parts.live, *what, parts.options.who); !ok) return Unexpected(ok.error());
    parts.options.output.take_keys(TakenKeys::all);
    parts.show(fmt::format("at full deflection: {}\ndriving {}: arrow keys, + and - scale, space stops, Esc ends",
                           parts.drive.full_speed(), parts.drive.path()));
    return CommandEnd::done;
}

Expected<CommandEnd> command_inject(Session::Parts& parts, const Arguments& arguments) {
    return done(parts.objects->act_on_port(arguments.lua, arguments.index(1), "inject"));
}

Expected<CommandEnd> command_hold(Session::Parts& parts, const Arguments& arguments) {
    return done(parts.objects->act_on_port(arguments.lua, arguments.index(1), "hold"));
}

Expected<CommandEnd> command_release(Session::Parts& parts, const Arguments& arguments) {
    return done(parts.objects->act_on_port(arguments.lua, arguments.index(1), "release"));
}

Expected<CommandEnd> command_teleport(Session::Parts& parts, const Arguments& arguments) {
    if (parts.clock.is_hardware()) return failure("real robots can't be teleported: this works only in simulation");
    if (arguments.count() < 1)
        return failure("expected a marker, robot or object, as in teleport(\"target\", { x = 1 })");
    const auto teleport = read_teleport(*parts.objects, parts.live, arguments.lua, 1, 2);
    if (!teleport) return Unexpected(teleport.error());
    return done(parts.act(teleport->act));
}

Expected<CommandEnd> command_stop(Session::Parts& parts, const Arguments&) { return done(parts.act(Stop{})); }

Expected<CommandEnd> command_rearm(Session::Parts& parts, const Arguments&) { return done(parts.act(Rearm{})); }

}  // namespace nezumi

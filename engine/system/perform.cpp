// Performs acts on a system: looks up the names, checks the act, and then changes the system.
#include "engine/system/perform.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "engine/ports/payload.hpp"
#include "engine/ports/setting.hpp"
#include "engine/system/published.hpp"
#include "engine/system/system_spec.hpp"
#include "engine/values/limits.hpp"

namespace nezumi {
namespace {

// The result of an act that has no result besides success or an error.
Expected<ActResult> result_of(const Expected<void>& done) {
    if (!done) return Unexpected(done.error());
    return ActResult{};
}

// The port for an act. An error for an in-port of another host: messages reach it on that host, so an act on this host
// would have no effect.
Expected<Port*> port_here(System& system, const std::string& path) {
    auto port = system.port(path);
    if (!port || (*port)->direction() == Direction::out || !is_remote(path)) return port;
    return failure(fmt::format(
        "{} gets its messages on host '{}': do this on that host, or with the out-port of this host that it is "
        "connected to",
        path, host_of(path)));
}

// An error if the port can't have this value.
Expected<void> check_fits(const Port& port, const std::string& path, const Value& value) {
    if (port.type() != message_of(value.type())) {
        return failure(
            fmt::format("types differ: {} is {}, the value is {}", path, port.type_name(), message_name(value.type())));
    }
    if (!is_finite(value)) return failure(fmt::format("{}: a number of the value is not finite", path));
    if (const std::string wrong = find_misfit(value); !wrong.empty())
        return failure(fmt::format("{}: {}", path, wrong));
    return {};
}

Expected<ActResult> send(Port& port, const std::string& path, const Value& value) {
    if (auto fits = check_fits(port, path, value); !fits) return Unexpected(fits.error());
    if (port.direction() == Direction::in) {
        static_cast<InPortBase&>(port).inject(value);
    } else {
        static_cast<OutPortBase&>(port).write_any(value);
    }
    return ActResult{};
}

// Performs a `Write` or an `Inject`.
template <class Message>
Expected<ActResult> send(System& system, const Message& act) {
    const auto port = port_here(system, act.port);
    return port ? send(**port, act.port, act.value) : Unexpected(port.error());
}

// An error if another actor holds the port.
Expected<void> check_holder(const System& system, const std::string& path, const Actor& who) {
    const Actor* holder = system.holder(path);
    if (holder == nullptr || *holder == who) return {};
    return failure(fmt::format("{} is held by another user ({}): hold(port, value, {{ take = true }}) takes it", path,
                               to_text(*holder)));
}

template <class Put>
Expected<ActResult> override_port(System& system, const std::string& path, const Actor& who, const Put& put) {
    const auto port = port_here(system, path);
    if (!port) return Unexpected(port.error());
    if (auto mine = check_holder(system, path, who); !mine) return Unexpected(mine.error());
    put(**port);
    system.set_holder(path, who);
    return ActResult{};
}

template <class Do>
Expected<ActResult> with_component(System& system, const std::string& name, const Do& action) {
    const auto component = system.component(name);
    if (!component) return Unexpected(component.error());
    return result_of(action(**component));
}

// A robot that a user can move, the world that moves it, and its id in this world.
struct HandledRobot {
    const Robot* robot;
    World* world;
    RobotId id;
};

Expected<HandledRobot> handled_robot(System& system, const std::string& name) {
    const auto component = system.component(name);
    if (!component) return Unexpected(component.error());
    const auto seen = seen_robot(system, **component);
    if (!seen) return Unexpected(seen.error());
    World* world = seen->robot->is_real() ? system.rig()->world.get() : system.world();
    return HandledRobot{seen->robot, world, seen->id};
}

// Logs which robots of other hosts and of ROS get speed 0 in an emergency stop, and which robots it does not reach.
void tell_robots_elsewhere(const System& system) {
    for (const ConnectionSpec& each : system.connections()) {
        const auto from = system.port(each.from);
        const auto to = system.port(each.to);
        if (!is_remote(each.to) || !from || !to) continue;
        if (!commands_robots(system, static_cast<const OutPortBase&>(**from))) continue;
        const std::string& missing = (*to)->note();
        if (missing.empty()) {
            system.log(LogLevel::warn, fmt::format("emergency stop: {} gets speed 0 until rearm()", each.to));
        } else {
            system.log(LogLevel::warn,
                       fmt::format("the emergency stop does not reach {}: {}: stop it there", each.to, missing));
        }
    }
}

}  // namespace

Expected<SeenRobot> seen_robot(const System& system, const Component& component) {
    const auto* robot = dynamic_cast<const Robot*>(&component);
    if (robot == nullptr) return failure(fmt::format("{} is not a robot", component.name()));
    const std::string& name = robot->name();
    if (!robot->has_body()) return failure(fmt::format("{} has no body yet", name));
    if (robot->is_real() && system.rig() != nullptr) {
        if (const auto id = system.rig()->find(name)) return SeenRobot{robot, system.rig()->world.get(), *id};
        return failure(fmt::format("{}{}: run this in simulation, or give --rig {}=SOCKET", name, not_seen, name));
    }
    if (robot->is_real()) return failure(fmt::format("{} is a real robot: this works only in simulation", name));
    if (system.world() == nullptr) return failure("this works only in simulation, and there is no simulated world");
    return SeenRobot{robot, system.world(), robot->id()};
}

Expected<ActResult> perform(System& system, const SetParameter& act, const Actor& /*who*/) {
    return with_component(system, act.component, [&](Component& component) -> Expected<void> {
        Parameters& parameters = component.parameters();
        if (const auto* known = parameters.find(act.parameter)) {
            if (auto fits = check_value(known->spec, act.value); !fits) return Unexpected(fits.error());
            parameters.take_staged();  // the last value from the script is applied before this one
        }
        return parameters.set(act.parameter, act.value);
    });
}

Expected<ActResult> perform(System& system, const Write& act, const Actor& /*who*/) { return send(system, act); }

Expected<ActResult> perform(System& system, const Inject& act, const Actor& /*who*/) { return send(system, act); }

Expected<ActResult> deliver(Port& port, const Act& act) {
    if (const auto* inject = std::get_if<Inject>(&act)) return send(port, inject->port, inject->value);
    const auto& write = std::get<Write>(act);
    return send(port, write.port, write.value);
}

Expected<ActResult> perform(System& system, const Hold& act, const Actor& who) {
    const auto port = port_here(system, act.port);
    if (!port) return Unexpected(port.error());
    if (auto fits = check_fits(**port, act.port, act.value); !fits) return Unexpected(fits.error());
    const Actor* holder = system.holder(act.port);
    if (holder != nullptr && *holder != who) {
        if (!act.take) return result_of(check_holder(system, act.port, who));
        system.log(LogLevel::warn, fmt::format("{}: its value is held by {} now, no longer by {}", act.port,
                                               to_text(who), to_text(*holder)));
    }
    (*port)->hold(act.value);
    system.set_holder(act.port, who);
    return ActResult{};
}

Expected<ActResult> perform(System& system, const Release& act, const Actor& who) {
    const auto port = system.port(act.port);
    if (!port) return Unexpected(port.error());
    if (auto mine = check_holder(system, act.port, who); !mine) return Unexpected(mine.error());
    (*port)->release();
    return ActResult{};
}

Expected<ActResult> perform(System& system, const Drop& act, const Actor& who) {
    return override_port(system, act.port, who, [](Port& port) { port.drop(); });
}

Expected<ActResult> perform(System& system, const Freeze& act, const Actor& who) {
    return override_port(system, act.port, who, [](Port& port) { port.freeze(); });
}

Expected<ActResult> perform(System& system, const Activate& act, const Actor& /*who*/) {
    return with_component(system, act.component, [&](Component& each) { return each.activate(system.now()); });
}

Expected<ActResult> perform(System& system, const Deactivate& act, const Actor& /*who*/) {
    return with_component(system, act.component, [&](Component& each) { return each.deactivate(system.now()); });
}

Expected<ActResult> perform(System& system, const Reset& act, const Actor& /*who*/) {
    return with_component(system, act.component, [&](Component& each) { return each.reset(system.now()); });
}

Expected<ActResult> perform(System& system, const Use& act, const Actor& /*who*/) {
    return with_component(system, act.component, [&](Component& each) { return each.use(act.set); });
}

Expected<ActResult> perform(System& system, const Connect& act, const Actor& /*who*/) {
    return result_of(system.connect(act.from, act.to));
}

Expected<ActResult> perform(System& system, const Disconnect& act, const Actor& /*who*/) {
    if (!act.to.empty()) return result_of(system.disconnect(act.from, act.to));
    const bool was_foreign = system.disconnect_foreign(act.from);
    const auto port = is_foreign(act.from) ? failure(shown(act.from) + " is not connected") : system.port(act.from);
    if (!port && !was_foreign) return Unexpected(port.error());
    if (port && system.disconnect_all(**port).empty() && !was_foreign) return failure(act.from + " is not connected");
    return ActResult{};
}

Expected<ActResult> perform(System& system, const Teleport& act, const Actor& /*who*/) {
    const auto robot = handled_robot(system, act.robot);
    if (!robot) return Unexpected(robot.error());
    return result_of(robot->world->teleport(robot->id, act.pose));
}

Expected<ActResult> perform(System& system, const Disturb& act, const Actor& /*who*/) {
    const auto robot = handled_robot(system, act.robot);
    if (!robot) return Unexpected(robot.error());
    for (const auto& speed : {act.vx, act.vy, act.va}) {
        const std::string problem = speed ? check_number(*speed, {}, "") : "";
        if (!problem.empty()) return failure("disturb: a speed: " + problem);
    }
    robot->world->disturb(robot->id, {.vx = act.vx, .vy = act.vy, .va = act.va});
    return ActResult{};
}

Expected<ActResult> perform(System& system, const Press& act, const Actor& /*who*/) {
    const auto robot = handled_robot(system, act.robot);
    if (!robot) return Unexpected(robot.error());
    std::vector<std::string_view> names;
    const auto& sensors = robot->robot->spec().sensors;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        if (sensors[i].kind != SensorSpec::Kind::button && sensors[i].kind != SensorSpec::Kind::touch) continue;
        if (sensors[i].name == act.sensor) {
            robot->world->press(robot->id, i, act.pressed);
            return ActResult{};
        }
        names.emplace_back(sensors[i].name);
    }
    if (names.empty()) return failure(fmt::format("{} has no buttons", act.robot));
    const std::string near = did_you_mean(act.sensor, names);
    return failure(fmt::format("{} has no button '{}'{}", act.robot, shown(act.sensor),
                               near.empty() ? fmt::format(" (it has {})", fmt::join(names, ", ")) : near));
}

Expected<ActResult> perform(System& system, const Command& act, const Actor& /*who*/) {
    const auto component = system.component(act.component);
    if (!component) return Unexpected(component.error());
    auto values = (*component)->call_command(act.command, act.arguments, system.now());
    if (!values) return Unexpected(values.error());
    ActResult result;
    result.values = std::move(*values);
    return result;
}

Expected<ActResult> perform(System& system, const Stop& /*act*/, const Actor& who) {
    system.emergency_stop();
    system.log(LogLevel::warn, fmt::format("emergency stop by {}: rearm() lets the robots drive again", to_text(who)));
    tell_robots_elsewhere(system);
    return ActResult{};
}

Expected<ActResult> perform(System& system, const Rearm& /*act*/, const Actor& /*who*/) {
    return result_of(system.rearm());
}

}  // namespace nezumi

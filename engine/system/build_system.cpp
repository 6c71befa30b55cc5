// Entries become components, in order, each error with the place of its line.
#include "engine/system/build_system.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/schedule.hpp"

namespace nezumi {
namespace {

Unexpected at(const Place& place, const Error& error) {
    return failure(error.message, error.place.file.empty() ? place : error.place);
}

bool is_outside(const ArenaSpec& arena, const Point2D& place) {
    return arena.size && (std::abs(place.x) > arena.size->x / 2 || std::abs(place.y) > arena.size->y / 2);
}

using Body = Expected<std::unique_ptr<RobotBody>>;

Body add_body(System& system, const RobotEntry& entry, const SystemSpec& spec) {
    const auto model = spec.models.find(entry.model);
    if (model == spec.models.end() || system.world() == nullptr) return nullptr;  // `add_robot` says so
    return system.world()->add_robot(entry.name, model->second, entry.pose);
}

// `early` is the robot's body when it is in the world already.
Expected<Component*> add_robot(System& system, const RobotEntry& entry, const SystemSpec& spec, Body* early) {
    const auto model = spec.models.find(entry.model);
    if (model == spec.models.end()) {
        std::vector<std::string_view> names;
        for (const auto& [name, known] : spec.models) names.push_back(name);
        return failure(fmt::format("robot '{}': there is no model '{}'{}", entry.name, entry.model,
                                   did_you_mean(entry.model, names)),
                       entry.place);
    }
    if (system.world() == nullptr)
        return failure(fmt::format("robot '{}': there is no world to put it in", entry.name), entry.place);
    Limits limits = model->second.drive.limits;
    limits.speed = entry.speed.value_or(limits.speed);
    limits.yaw_rate = entry.yaw_rate.value_or(limits.yaw_rate);
    limits.acceleration = entry.acceleration.value_or(limits.acceleration);
    limits.yaw_acceleration = entry.yaw_acceleration.value_or(limits.yaw_acceleration);

    auto robot = Robot::make(entry.name, model->second, limits, system.next_robot_id(), system.settings().seed);
    if (!robot) return at(entry.place, robot.error());
    Robot* made = robot->get();
    made->place = entry.place;
    auto added = system.add(std::move(*robot));
    if (!added) return added;
    auto body = early != nullptr ? std::move(*early) : add_body(system, entry, spec);
    if (!body) {
        // Nothing half done: it may be added elsewhere under the same name.
        static_cast<void>(system.remove(entry.name));
        return at(entry.place, body.error());
    }
    made->take_body(std::move(*body));
    if (spec.arena.border && is_outside(spec.arena, entry.pose.position)) {
        system.log(LogLevel::warn,
                   fmt::format("robot '{}' at x = {:g}, y = {:g} is outside the arena of {:g} x {:g} m", entry.name,
                               entry.pose.position.x, entry.pose.position.y, spec.arena.size->x, spec.arena.size->y));
    }
    return added;
}

// Sets these values, all or none. `path` is the table that they come from: an error has the place of its field.
template <class AnEntry>
Expected<void> set_values(Parameters& parameters, const ParameterValues& values, const AnEntry& entry,
                          const std::string& path, const std::string& what) {
    if (parameters.set_all(values)) return {};
    for (const auto& [name, value] : values) {
        const auto ok = parameters.set(name, value);
        if (ok) continue;
        const auto place = entry.places.find(path + "." + name);
        return failure(fmt::format("{}: {}: {}", entry.name, what, ok.error().message),
                       place != entry.places.end() ? place->second : entry.place);
    }
    return {};
}

template <class AnEntry>
Expected<void> configure(Component& component, const AnEntry& entry) {
    component.configured = entry.config;
    return set_values(component.parameters(), entry.config, entry, "config", "config");
}

Expected<Component*> add_behavior(System& system, const BehaviorEntry& entry, const Makers& makers) {
    auto made = makers.behavior(entry, {.seed = system.settings().seed, .tick_rate = system.settings().rate});
    if (!made) return at(entry.place, made.error());
    Component& component = **made;
    component.rate = entry.rate;
    component.place = entry.place;
    if (auto ok = configure(component, entry); !ok) return Unexpected(ok.error());
    component.sets = entry.sets;
    for (const auto& [name, values] : entry.sets) {
        Parameters trial = component.parameters();
        if (auto ok = set_values(trial, values, entry, "sets." + name, fmt::format("set '{}'", name)); !ok)
            return Unexpected(ok.error());
    }
    if (!entry.set.empty()) {
        if (auto ok = component.use(entry.set); !ok) return at(entry.place, ok.error());
    }
    return system.add(std::move(*made));
}

Expected<Component*> add_native(System& system, const ComponentEntry& entry, const Makers& makers) {
    const auto maker = makers.components.find(entry.type);
    if (maker == makers.components.end()) {
        std::vector<std::string_view> names;
        for (const auto& [name, make] : makers.components) names.push_back(name);
        std::string hint = did_you_mean(entry.type, names);
        if (hint.empty() && !names.empty()) hint = fmt::format("; there are {}", fmt::join(names, ", "));
        return failure(fmt::format("component '{}': there is no type '{}'{}", entry.name, entry.type, hint),
                       entry.place);
    }
    auto made = maker->second(entry, system);
    if (!made) return at(entry.place, made.error());
    (*made)->rate = entry.rate;
    (*made)->place = entry.place;
    if (auto ok = configure(**made, entry); !ok) return Unexpected(ok.error());
    return system.add(std::move(*made));
}

}  // namespace

Expected<Component*> add_entry(System& system, const Entry& entry, const SystemSpec& spec, const Makers& makers) {
    if (const auto* robot = std::get_if<RobotEntry>(&entry)) return add_robot(system, *robot, spec, nullptr);
    if (const auto* behavior = std::get_if<BehaviorEntry>(&entry)) return add_behavior(system, *behavior, makers);
    return add_native(system, std::get<ComponentEntry>(entry), makers);
}

Expected<std::unique_ptr<System>> build_system(const SystemSpec& spec, const Makers& makers,
                                               const BuildOptions& options) {
    if (auto steps = steps_per_tick(spec.rate, spec.physics_step); !steps) return at(spec.rate_place, steps.error());
    const std::uint64_t seed = options.seed_wins ? options.seed : spec.seed.value_or(options.seed);
    auto system = std::make_unique<System>(System::Settings{.rate = spec.rate,
                                                            .physics_step = spec.physics_step,
                                                            .seed = seed,
                                                            .threads = options.threads,
                                                            .out_of_time_is_fatal = options.out_of_time_is_fatal},
                                           options.log);
    if (makers.world) {
        auto world = makers.world(spec.arena, {.step = spec.physics_step, .seed = seed},
                                  [log = options.log, owner = system.get()](const std::string& text) {
                                      if (log) log({LogLevel::warn, owner->now().seconds, "", text});
                                  });
        if (!world) return Unexpected(world.error());
        system->take_world(std::move(*world));
    }
    // The bodies come first, to lie side by side in memory: each physics step visits all of them, and a thousand robots
    // with their scripts' states in between cost a third more. What is wrong with one is told in the order of the file.
    std::vector<Body> bodies;
    for (const Entry& entry : spec.entries) {
        if (const auto* robot = std::get_if<RobotEntry>(&entry)) bodies.push_back(add_body(*system, *robot, spec));
    }
    auto body = bodies.begin();
    for (const Entry& entry : spec.entries) {
        const auto* robot = std::get_if<RobotEntry>(&entry);
        auto added =
            robot != nullptr ? add_robot(*system, *robot, spec, &*body++) : add_entry(*system, entry, spec, makers);
        if (!added) return Unexpected(added.error());
    }
    for (const ConnectionSpec& connection : spec.connections) {
        if (auto ok = system->connect(connection.from, connection.to); !ok) return at(connection.place, ok.error());
    }
    return system;
}

void activate_all(System& system, const SystemSpec& spec) {
    for (const Entry& entry : spec.entries) {
        if (!std::visit([](const auto& e) { return e.active; }, entry)) continue;
        Component* component = system.find(name_of(entry));
        // A failure has put the component into ERROR and is in the log.
        if (component != nullptr) static_cast<void>(component->activate(system.now()));
    }
}

}  // namespace nezumi

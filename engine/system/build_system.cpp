// Makes a component of each entry, in order. Each error has the location of the wrong line.
#include "engine/system/build_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/list.hpp"
#include "engine/base/schedule.hpp"
#include "engine/components/quotes_hint.hpp"
#include "engine/system/peer_word.hpp"
#include "engine/system/robot_limits.hpp"
#include "engine/system/script_drivers.hpp"

namespace nezumi {
namespace {

Unexpected at(const Place& place, const Error& error) {
    return failure(error.message, error.place.file.empty() ? place : error.place);
}

std::string_view backend_of(const std::string& backend) { return backend.empty() ? simulated : backend; }

// The error for a name that does not exist, with the nearest or all existing names.
std::string no_such(std::string_view kind, std::string_view name, const std::vector<std::string_view>& names) {
    std::string hint = did_you_mean(name, names);
    if (hint.empty() && !names.empty())
        hint = fmt::format("; there {} {}", names.size() == 1 ? "is" : "are", fmt::join(names, ", "));
    return fmt::format("there is no {} '{}'{}", kind, shown(name), hint);
}

template <class Map>
std::vector<std::string_view> keys_of(const Map& map) {
    std::vector<std::string_view> keys;
    keys.reserve(map.size());
    for (const auto& [key, value] : map) keys.push_back(key);
    return keys;
}

// A robot that names its model's driver is simulated in a run that has no drivers.
RobotEntry as_run(RobotEntry entry, const SystemSpec& spec, const Makers& makers) {
    const auto model = spec.models.find(entry.described_by());
    const bool is_its_driver = model != spec.models.end() && model->second.hardware.backend() == entry.backend;
    if (is_its_driver && makers.bodies.empty()) entry.backend.clear();
    return entry;
}

using Body = Expected<std::unique_ptr<RobotBody>>;

Body add_body(System& system, const RobotEntry& entry, const SystemSpec& spec, const Makers& makers) {
    const auto refuse = [&](std::string_view why) {
        return failure(fmt::format("robot '{}': {}", entry.name, why), entry.place);
    };
    const auto model = spec.models.find(entry.described_by());
    if (model == spec.models.end()) return refuse(no_such("model", entry.model, keys_of(spec.models)));
    const std::string_view backend = backend_of(entry.backend);
    if (backend == scripted && !entry.driver.empty()) return nullptr;
    if (backend == simulated) {
        if (system.world() == nullptr) return refuse("there is no simulated world to put it in");
        return system.world()->add_robot(entry.name, model->second, entry.pose);
    }
    const auto maker = makers.bodies.find(backend);
    if (maker != makers.bodies.end()) return maker->second(entry, model->second);
    std::vector<std::string_view> names{simulated};
    for (const std::string_view name : keys_of(makers.bodies)) names.push_back(name);
    const std::string& driver = model->second.hardware.driver;
    if (!driver.empty() && makers.bodies.empty()) names.emplace_back(driver);
    return refuse(no_such("backend", backend, names));
}

Expected<Component*> add_robot(System& system, const RobotEntry& entry, const SystemSpec& spec, const Makers& makers,
                               Body body) {
    const auto model = spec.models.find(entry.described_by());
    if (model == spec.models.end()) return Unexpected(body.error());
    const std::string& driver = model->second.hardware.driver;
    if (!driver.empty() && !makers.drivers.empty()) {
        const std::vector<std::string_view> known(makers.drivers.begin(), makers.drivers.end());
        if (!contains(known, driver))
            return failure(fmt::format("robot '{}': hardware: {}", entry.name, no_such("driver", driver, known)),
                           entry.place);
    }
    auto robot = Robot::make(entry.name, model->second, limits_of(entry, model->second.drive));
    if (!robot) return at(entry.place, robot.error());
    Robot* made = robot->get();
    made->place = entry.place;
    auto added = system.add(std::move(*robot));
    if (!added) return added;
    if (!body) {
        // Removes an incomplete component, because its name may be used for another one.
        static_cast<void>(system.remove(entry.name));
        return at(entry.place, body.error());
    }
    if (entry.driver.empty()) {
        made->take_body(std::move(*body));
    } else {
        made->take_scripted_body(std::move(*body));
    }
    if (entry.odometry_at_pose) made->set_odometry(entry.pose);
    if (const std::string lowered = lowered_limits(entry, model->second.drive); !lowered.empty())
        system.log(LogLevel::warn, describe({fmt::format("robot '{}': {}", entry.name, lowered), entry.place}));
    const Robot* real = entry.twin_of.empty() ? nullptr : system.find_robot(entry.twin_of);
    if (real == nullptr) return added;
    if (auto ok = made->follow(*real, *system.world()); !ok)
        return failure(fmt::format("robot '{}': {}", entry.name, ok.error().message), entry.place);
    return added;
}

// Sets these values, all or none. `path` is the table that they come from: an error has the location of its field.
template <class AnEntry>
Expected<void> set_values(Parameters& parameters, const ParameterValues& values, const AnEntry& entry,
                          const std::string& path, const std::string& what) {
    if (parameters.set_all(values)) return {};
    for (const auto& [name, value] : values) {
        const auto ok = parameters.set(name, value);
        if (ok) continue;
        const auto found = entry.places.find(fmt::format("{}.{}", path, name));
        const Place& place = found != entry.places.end() ? found->second : entry.place;
        const auto* parameter = parameters.find(name);
        const std::string hint = parameter != nullptr ? quotes_hint(parameter->spec, value, place.file) : "";
        return failure(fmt::format("{}: {}: {}{}", entry.name, what, ok.error().message, hint), place);
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
        if (auto ok = set_values(trial, values, entry, "sets." + name, fmt::format("set '{}'", shown(name))); !ok)
            return Unexpected(ok.error());
    }
    if (!entry.set.empty()) {
        if (auto ok = component.use(entry.set); !ok) return at(entry.place, ok.error());
    }
    return system.add(std::move(*made));
}

Expected<Component*> add_native(System& system, const ComponentEntry& entry, const Makers& makers) {
    const auto refuse = [&](std::string_view why) {
        return failure(fmt::format("component '{}': {}", entry.name, why), entry.place);
    };
    const auto type = makers.components.find(entry.type);
    if (type == makers.components.end()) return refuse(no_such("type", entry.type, keys_of(makers.components)));
    const std::string_view backend = backend_of(entry.backend);
    const auto maker = type->second.find(backend);
    if (maker == type->second.end()) return refuse(no_such("backend", backend, keys_of(type->second)));
    auto made = maker->second(entry, system);
    if (!made) return at(entry.place, made.error());
    (*made)->rate = entry.rate;
    (*made)->place = entry.place;
    if (auto ok = configure(**made, entry); !ok) return Unexpected(ok.error());
    return system.add(std::move(*made));
}

// The check of connections to other programs, by the words of these peers. Empty if the program has no such words.
System::ForeignCheck foreign_check(const PeerWords& words, const SystemSpec& spec) {
    if (words.empty()) return {};
    return [words, peers = spec.peers](const System& system, const ConnectionSpec& connection) -> Expected<void> {
        const PeerWord* word = word_of_port(words, connection.from);
        if (word == nullptr) word = word_of_port(words, connection.to);
        if (word == nullptr) {
            return failure(fmt::format("{} to {}: this program can't connect to ports of other programs",
                                       connection.from, connection.to));
        }
        const auto its = peers.find(word->name());
        return word->check_connection(system, its == peers.end() ? nullptr : its->second.get(), connection);
    };
}

}  // namespace

Expected<Component*> add_entry(System& system, const Entry& entry, const SystemSpec& spec, const Makers& makers) {
    if (const auto* given = std::get_if<RobotEntry>(&entry)) {
        const RobotEntry robot = as_run(*given, spec, makers);
        return add_robot(system, robot, spec, makers, add_body(system, robot, spec, makers));
    }
    if (const auto* behavior = std::get_if<BehaviorEntry>(&entry)) return add_behavior(system, *behavior, makers);
    return add_native(system, std::get<ComponentEntry>(entry), makers);
}

MakerContext context_of(const SystemSpec& spec, const BuildOptions& options) {
    return {.seed = options.seed_wins ? options.seed : spec.seed.value_or(options.seed), .tick_rate = spec.rate};
}

Expected<std::unique_ptr<System>> build_system(const SystemSpec& spec, const Makers& makers,
                                               const BuildOptions& options) {
    if (auto steps = steps_per_tick(spec.rate, spec.physics_step); !steps) return at(spec.rate_place, steps.error());
    const std::uint64_t seed = context_of(spec, options).seed;
    auto system = std::make_unique<System>(System::Settings{.rate = spec.rate,
                                                            .physics_step = spec.physics_step,
                                                            .seed = seed,
                                                            .threads = options.threads,
                                                            .out_of_time_is_fatal = options.out_of_time_is_fatal,
                                                            .real_time = options.real_time,
                                                            .clock = options.clock},
                                           options.log);
    if (makers.world) {
        auto world = makers.world(spec.arena, {.step = spec.physics_step, .seed = seed},
                                  [log = options.log, owner = system.get()](const std::string& text) {
                                      if (log) log({LogLevel::warn, owner->now().seconds, "", text});
                                  });
        if (!world) return Unexpected(world.error());
        system->take_world(std::move(*world));
    }
    if (makers.rig) {
        auto rig = makers.rig(spec);
        if (!rig) return Unexpected(rig.error());
        system->take_rig(std::move(*rig));
    }
    // The bodies come first, to lie side by side in memory: each physics step visits all of them, and a thousand robots
    // with their scripts' states in between cost a third more. Errors are reported in the order of the file.
    std::vector<Body> bodies;
    for (const RobotEntry* robot : entries_of<RobotEntry>(spec))
        bodies.push_back(add_body(*system, as_run(*robot, spec, makers), spec, makers));
    std::set<std::string, std::less<>> left_out;
    const auto is_left_out = [&](std::string_view port) { return left_out.contains(port.substr(0, port.find('.'))); };
    auto body = bodies.begin();
    for (const Entry& entry : spec.entries) {
        const auto* robot = std::get_if<RobotEntry>(&entry);
        auto added = robot != nullptr
                         ? add_robot(*system, as_run(*robot, spec, makers), spec, makers, std::move(*body++))
                         : add_entry(*system, entry, spec, makers);
        if (added) continue;
        if (!options.keep_going || !std::holds_alternative<BehaviorEntry>(entry)) return Unexpected(added.error());
        left_out.insert(name_of(entry));
        system->log(LogLevel::error, describe(added.error()) + ": omitted, and the others continue");
    }
    const auto networked = std::find_if(spec.peers.begin(), spec.peers.end(),
                                        [](const auto& peer) { return peer.second->word().needs_network(); });
    if (networked != spec.peers.end()) {
        const auto& [word, peer] = *networked;
        if (!makers.network) return failure(fmt::format("{}: this program can't use a network", word), peer->place());
        auto network = makers.network(spec, *system);
        if (!network) return at(peer->place(), network.error());
        system->take_network(std::move(*network));
    }
    system->take_foreign_check(foreign_check(makers.peer_words, spec));
    if (auto ok = connect_script_drivers(*system, spec); !ok) return Unexpected(ok.error());
    for (const ConnectionSpec& connection : spec.connections) {
        if (is_left_out(connection.from) || is_left_out(connection.to)) continue;
        const auto made = system->connect(connection.from, connection.to);
        if (made) continue;
        if (!is_foreign(connection.from) && !is_foreign(connection.to)) return at(connection.place, made.error());
        return failure("connect: " + made.error().message, connection.place);
    }
    return system;
}

void note_added(System& system, SystemSpec& spec, std::string_view component, const Actor& who, const Makers& makers) {
    const auto peers = spec.peers;  // a copy, because each word may replace its entry
    for (const auto& [name, peer] : peers) peer->word().note_added(spec, component, who);
    system.take_foreign_check(foreign_check(makers.peer_words, spec));
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

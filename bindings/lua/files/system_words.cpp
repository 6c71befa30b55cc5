// Behaviours, components, connections and rates of a system file.
#include "bindings/lua/files/system_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/lua/files/find_script.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "engine/base/list.hpp"
#include "engine/base/names.hpp"
#include "engine/base/schedule.hpp"
#include "engine/components/component.hpp"
#include "engine/records/read_record.hpp"
#include "engine/system/peer_word.hpp"
#include "engine/system/system_fields.hpp"
#include "engine/world/arena_fields.hpp"

namespace nezumi {
namespace {

std::string_view kind_of(const Entry& entry) {
    constexpr std::string_view kinds[] = {"robot", "behavior", "component"};
    return kinds[entry.index()];
}

// The locations of the values of `config` and of the sets, by path.
void note_places(FieldPlaces& places, const FieldCheck& check, const FieldPath& table, const ParameterValues& values) {
    for (const auto& [name, value] : values) {
        FieldPath path = table;
        path.push_back(name);
        places.emplace(to_text(path), check.place_of(path));
    }
}

// "name.port" or "host/name.port", all identifiers; the name of a port may be a keyword of Lua ("in").
bool is_port_path(std::string_view path) {
    if (const std::size_t slash = path.find('/'); slash != std::string_view::npos) {
        if (!is_identifier(path.substr(0, slash))) return false;
        path.remove_prefix(slash + 1);
    }
    const std::size_t dot = path.find('.');
    if (dot == std::string_view::npos) return false;
    const std::string_view port = path.substr(dot + 1);
    return is_identifier(path.substr(0, dot)) && (is_identifier(port) || is_keyword(port));
}

// A number in messages.
std::string text_of(double number) { return std::isnan(number) ? "nan" : fmt::format("{}", number); }

}  // namespace

Unexpected repeated(const WordCall& call, const Place& first) {
    return failure(fmt::format("{}: is set already, at {}:{}", call.word, first.file, first.line), call.place);
}

bool is_taken_name(std::string_view name) {
    const auto& library = sandbox_names();
    return is_reserved_name(name) || contains(library, name);
}

SystemWords::SystemWords(const Project& project, PeerWords words, SystemSpec start)
    : project_(project), words_(std::move(words)), spec_(std::move(start)) {
    for (const Entry& entry : spec_.entries) names_.emplace(name_of(entry), names_.size());
    for (const ConnectionSpec& connection : spec_.connections) wired_.emplace(connection.from, connection.to);
}

void SystemWords::note_file(const std::string& shown) { add_once(spec_.files, shown); }

Expected<void> SystemWords::check_name(const WordCall& call, const std::string& name) const {
    const std::string what = fmt::format("{} '{}'", call.word, name);
    if (is_taken_name(name)) {
        return failure(
            fmt::format("{}: '{}' is a keyword of Lua or a command of the console: choose another name", what, name),
            call.place);
    }
    if (!is_identifier(name)) {
        return failure(
            fmt::format("{}: a name consists of letters, digits and _, and does not begin with a digit", what),
            call.place);
    }
    if (const auto taken = names_.find(name); taken != names_.end()) {
        const Entry& other = spec_.entries[taken->second];
        return failure(fmt::format("{}: the name is already used by the {} at {}:{}", what, kind_of(other),
                                   place_of(other).file, place_of(other).line),
                       call.place);
    }
    return {};
}

Expected<void> SystemWords::entry(const WordCall& call, const std::string& name, const Value& fields) {
    if (auto ok = check_name(call, name); !ok) return ok;
    const auto add = [&](auto read) -> Expected<void> {
        if (!read) return Unexpected(read.error());
        names_.emplace(read->name, spec_.entries.size());
        spec_.entries.emplace_back(std::move(*read));
        return {};
    };
    if (call.word == "robot") return add(read_robot(call, name, fields));
    if (call.word == "behavior") return add(read_behavior(call, name, fields));
    return add(read_component(call, name, fields));
}

Expected<std::size_t> SystemWords::begin_entry(const WordCall& call, const Value& name) {
    const std::string* text = name.get_if<std::string>();
    if (text == nullptr) {
        return failure(fmt::format("{0}: expected a name, got {1}: write {0} \"NAME\" {{ ... }}", call.word,
                                   nezumi::kind_of(name)),
                       call.place);
    }
    if (auto ok = check_name(call, *text); !ok) return Unexpected(ok.error());
    pending_.push_back({call, *text});
    return pending_.size() - 1;
}

Expected<void> SystemWords::complete_entry(std::size_t pending, const Value& fields) {
    if (pending >= pending_.size()) return failure("this table comes too late: its name was given to an earlier world");
    pending_[pending].complete = true;
    const PendingEntry call = pending_[pending];
    return entry(call.call, call.name, fields);
}

std::string SystemWords::pending_title(std::size_t pending) const {
    return pending < pending_.size() ? fmt::format("{} '{}'", pending_[pending].call.word, pending_[pending].name)
                                     : "NAME";
}

Expected<SystemWords::FoundFile> SystemWords::find_file(const WordCall& call, FileKind kind, const std::string& name) {
    const std::tuple key(kind, name, call.place.file);
    if (const auto known = found_.find(key); known != found_.end()) return known->second;
    const auto path = kind == FileKind::script ? find_script(project_, name, call.place.file)
                                               : project_.find(kind, name, call.place.file);
    if (!path) return Unexpected(path.error());
    return found_.emplace(key, FoundFile{*path, project_.shown(*path)}).first->second;
}

Expected<BehaviorEntry> SystemWords::read_behavior(const WordCall& call, const std::string& name, const Value& value) {
    FieldCheck check = check_of(call, value, name);
    Fields fields(check, value);
    BehaviorEntry entry;
    entry.name = name;
    entry.place = call.place;
    read_record(fields, entry);
    fields.done();
    if (entry.sets.contains(Component::no_set)) {
        check.explain({"sets", std::string(Component::no_set)},
                      "the name \"default\" means that no set is in use: choose another name");
    }
    if (entry.sets.contains("")) check.explain({"sets", ""}, "a set needs a name");
    if (!entry.set.empty() && !entry.sets.contains(entry.set)) {
        check.explain(fields.path_of("set"),
                      fmt::format("there is no set '{}' in 'sets'{}", entry.set,
                                  did_you_mean(entry.set, entry.sets, &decltype(entry.sets)::value_type::first)));
    }
    if (check.ok()) {
        if (const auto script = find_file(call, FileKind::script, entry.script)) {
            entry.path = script->shown;
        } else {
            check.wrong_at({"script"}, script.error().message);
        }
    }
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    if (fields.has("rate")) rate_places_[name] = check.place_of({"rate"});
    note_places(entry.places, check, {"config"}, entry.config);
    for (const auto& [set, values] : entry.sets) note_places(entry.places, check, {"sets", set}, values);
    return entry;
}

Expected<ComponentEntry> SystemWords::read_component(const WordCall& call, const std::string& name,
                                                     const Value& value) {
    FieldCheck check = check_of(call, value, name);
    Fields fields(check, value);
    ComponentEntry entry;
    entry.name = name;
    entry.place = call.place;
    read_record(fields, entry);
    fields.done();
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    if (fields.has("rate")) rate_places_[name] = check.place_of({"rate"});
    note_places(entry.places, check, {"config"}, entry.config);
    if (fields.has("calibration")) {
        if (auto used = use_ros_calibration(call, check, entry); !used) return Unexpected(used.error());
    }
    note_degrees(check, call, fmt::format("component '{}'", name), "yaw", entry.yaw);
    return entry;
}

Expected<void> SystemWords::connect(const WordCall& call, const Value& from, const Value& to) {
    ConnectionSpec connection;
    connection.place = call.place;
    const auto word_of = [&](const Value& end) {
        const std::string* path = end.get_if<std::string>();
        return path != nullptr ? word_of_port(words_, *path) : nullptr;
    };
    for (auto [value, out] : {std::pair{&from, &connection.from}, std::pair{&to, &connection.to}}) {
        const std::string* path = value->get_if<std::string>();
        if (const PeerWord* word = word_of(*value)) {
            if (auto ok = word->check_port(*path); !ok) return failure("connect: " + ok.error().message, call.place);
        } else if (path == nullptr || !is_port_path(*path)) {
            const std::string got = path == nullptr ? nezumi::kind_of(*value) : "'" + *path + "'";
            return failure(fmt::format("connect: expected \"name.port\", got {}", got), call.place);
        }
        *out = *path;
    }
    if (word_of(from) != nullptr && word_of(to) != nullptr) {
        return failure("connect: both ends are ports of other programs: one of them must be of this system",
                       call.place);
    }
    auto& connections = spec_.connections;
    if (!wired_.emplace(connection.from, connection.to).second) {
        const auto other = std::find(connections.begin(), connections.end(), connection);
        return failure(fmt::format("connect: {} is connected to {} already, at {}:{}", connection.from, connection.to,
                                   other->place.file, other->place.line),
                       call.place);
    }
    connections.push_back(std::move(connection));
    return {};
}

Expected<void> SystemWords::seed(const WordCall& call, const Value& value) {
    const auto* whole = value.get_if<std::int64_t>();
    const auto* number = value.get_if<double>();
    const bool is_whole = number != nullptr && *number >= 0 && *number < 0x1p63 && *number == std::floor(*number);
    if (!is_whole && (whole == nullptr || *whole < 0)) {
        const std::string got = whole != nullptr    ? fmt::format("{}", *whole)
                                : number != nullptr ? text_of(*number)
                                                    : nezumi::kind_of(value);
        return failure(fmt::format("seed: expected a whole number from 0 on, got {}", got), call.place);
    }
    if (seed_place_) return repeated(call, *seed_place_);
    seed_place_ = call.place;
    spec_.seed = is_whole ? static_cast<std::uint64_t>(*number) : static_cast<std::uint64_t>(*whole);
    return {};
}

Expected<void> SystemWords::rate(const WordCall& call, const Value& hertz) {
    const auto value = number_of(hertz);
    if (!value || !std::isfinite(*value) || *value <= 0) {
        return failure(fmt::format("rate: expected a positive number of ticks per second, got {}",
                                   value ? text_of(*value) : nezumi::kind_of(hertz)),
                       call.place);
    }
    if (!spec_.rate_place.file.empty()) return repeated(call, spec_.rate_place);
    spec_.rate_place = call.place;
    spec_.rate = *value;
    return {};
}

Expected<void> SystemWords::physics(const WordCall& call, const Value& value) {
    FieldCheck check = check_of(call, value);
    Fields fields(check, value);
    PhysicsFields given;
    read_record(fields, given);
    fields.done();
    if (auto ok = check.result(); !ok) return ok;
    if (physics_place_) return repeated(call, *physics_place_);
    physics_place_ = call.place;
    spec_.physics_step = given.step;
    return {};
}

Expected<void> SystemWords::peer(const WordCall& call, const Value& fields) {
    const auto word =
        std::find_if(words_.begin(), words_.end(), [&](const PeerWord* each) { return each->name() == call.word; });
    auto given = (*word)->read({call, fields, project_, is_taken_name});
    if (!given) return Unexpected(given.error());
    const auto [earlier, is_first] = spec_.peers.try_emplace(call.word, std::move(*given));
    return is_first ? Expected<void>() : repeated(call, earlier->second->place());
}

Expected<void> SystemWords::finish(bool is_part) const {
    for (const PendingEntry& pending : pending_) {
        if (pending.complete) continue;
        return failure(fmt::format("{0} '{1}': expected a table after the name: {0} \"{1}\" {{ ... }}",
                                   pending.call.word, pending.name),
                       pending.call.place);
    }
    for (const Thing& thing : things_) {
        if (thing.placed) continue;
        return failure(fmt::format("{0}: it is not in the arena: write arena {{ {0} ... }}", thing.call.word),
                       thing.call.place);
    }
    if (auto ok = check_arena(spec_.arena); !ok) return ok;  // boxes of maps
    if (is_part) return {};
    if (auto ok = check_rates(); !ok) return ok;
    if (auto ok = check_lines(); !ok) return ok;
    if (auto ok = check_mazes(); !ok) return ok;
    for (const MarkerSpec& marker : spec_.arena.markers) {
        const auto taken = names_.find(marker.name);
        if (taken == names_.end()) continue;
        const Entry& other = spec_.entries[taken->second];
        return failure(fmt::format("marker '{}': the name is already used by the {} at {}:{}", marker.name,
                                   kind_of(other), place_of(other).file, place_of(other).line),
                       marker.place);
    }
    for (const PeerWord* word : words_) {
        if (auto ok = word->check(spec_); !ok) return ok;
    }
    std::vector<std::string_view> robots;
    for (const RobotEntry* robot : entries_of<RobotEntry>(spec_)) robots.push_back(robot->name);
    for (const ComponentEntry* component : entries_of<ComponentEntry>(spec_)) {
        if (component->on.empty()) continue;
        if (contains(robots, component->on)) continue;
        return failure(fmt::format("component '{}': field 'on': there is no robot '{}'{}", component->name,
                                   component->on, did_you_mean(component->on, robots)),
                       component->place);
    }
    return {};
}

Expected<void> SystemWords::check_rates() const {
    if (auto steps = steps_per_tick(spec_.rate, spec_.physics_step); !steps) {
        Place place = spec_.rate_place;
        if (place.file.empty() && physics_place_) place = *physics_place_;
        return failure(steps.error().message, place);
    }
    for (const Entry& entry : spec_.entries) {
        double rate = 0;
        if (const auto* behavior = std::get_if<BehaviorEntry>(&entry)) rate = behavior->rate;
        if (const auto* component = std::get_if<ComponentEntry>(&entry)) rate = component->rate;
        if (rate <= spec_.rate) continue;
        const auto place = rate_places_.find(name_of(entry));
        return failure(
            fmt::format(
                "{} '{}': a rate of {} Hz is above the tick's {} Hz: lower it, or raise the tick with rate(...)",
                kind_of(entry), name_of(entry), rate, spec_.rate),
            place == rate_places_.end() ? place_of(entry) : place->second);
    }
    return {};
}

}  // namespace nezumi

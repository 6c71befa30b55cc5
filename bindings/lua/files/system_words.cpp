// Behaviours, components, connections and rates of a system file.
#include "bindings/lua/files/system_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bindings/lua/files/find_script.hpp"
#include "bindings/lua/files/read_record.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "engine/base/names.hpp"
#include "engine/base/schedule.hpp"
#include "engine/components/component.hpp"
#include "engine/system/system_fields.hpp"
#include "engine/world/arena_fields.hpp"

namespace nezumi {
namespace {

std::string_view kind_of(const Entry& entry) {
    constexpr std::string_view kinds[] = {"robot", "behavior", "component"};
    return kinds[entry.index()];
}

// Where the values of `config` and of the sets stand, by path.
void note_places(FieldPlaces& places, const FieldCheck& check, const FieldPath& table, const ParameterValues& values) {
    for (const auto& [name, value] : values) {
        FieldPath path = table;
        path.push_back(name);
        places.emplace(to_text(path), check.place_of(path));
    }
}

template <class Sets>
std::vector<std::string_view> names_of(const Sets& sets) {
    std::vector<std::string_view> names;
    names.reserve(sets.size());
    for (const auto& [name, values] : sets) names.push_back(name);
    return names;
}

// "name.port" or "host/name.port", all identifiers; a port may be called like one of Lua's keywords ("in").
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

// A number as a message shows it.
std::string text_of(double number) { return std::isnan(number) ? "nan" : fmt::format("{}", number); }

}  // namespace

bool is_taken_name(std::string_view name) {
    const auto& library = sandbox_names();
    return is_reserved_name(name) || std::find(library.begin(), library.end(), name) != library.end();
}

SystemWords::SystemWords(const Project& project, SystemSpec start) : project_(project), spec_(std::move(start)) {
    for (const Entry& entry : spec_.entries) names_.emplace(name_of(entry), names_.size());
    for (const ConnectionSpec& connection : spec_.connections) wired_.emplace(connection.from, connection.to);
}

void SystemWords::note_file(const std::string& shown) {
    if (std::find(spec_.files.begin(), spec_.files.end(), shown) == spec_.files.end()) spec_.files.push_back(shown);
}

Expected<void> SystemWords::check_name(const WordCall& call, const std::string& name) const {
    const std::string what = fmt::format("{} '{}'", call.word, name);
    if (is_taken_name(name)) {
        return failure(fmt::format("{}: '{}' is a word of Lua or of the console: choose another name", what, name),
                       call.place);
    }
    if (!is_identifier(name)) {
        return failure(
            fmt::format("{}: a name consists of letters, digits and _, and does not begin with a digit", what),
            call.place);
    }
    if (const auto taken = names_.find(name); taken != names_.end()) {
        const Entry& other = spec_.entries[taken->second];
        return failure(fmt::format("{}: the name is taken by the {} of {}:{}", what, kind_of(other),
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
    begun_.push_back({call, *text});
    return begun_.size() - 1;
}

Expected<void> SystemWords::complete_entry(std::size_t begun, const Value& fields) {
    if (begun >= begun_.size()) return failure("the name before this table was of a world that was loaded since");
    begun_[begun].complete = true;
    const Begun call = begun_[begun];
    return entry(call.call, call.name, fields);
}

std::string SystemWords::begun_title(std::size_t begun) const {
    return begun < begun_.size() ? fmt::format("{} '{}'", begun_[begun].call.word, begun_[begun].name) : "NAME";
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
    FieldCheck check(fmt::format("behavior '{}'", name), call.word, call.place, call.source);
    check.set_given({name, &value});
    Fields fields(check, value);
    BehaviorEntry entry;
    entry.name = name;
    entry.place = call.place;
    read_record(fields, entry);
    fields.done();
    if (entry.sets.contains(Component::no_set)) {
        check.explain({"sets", std::string(Component::no_set)},
                      "to use \"default\" is to have no set in use: choose another name");
    }
    if (!entry.set.empty() && !entry.sets.contains(entry.set)) {
        check.explain(fields.path_of("set"), fmt::format("there is no set '{}' in 'sets'{}", entry.set,
                                                         did_you_mean(entry.set, names_of(entry.sets))));
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
    FieldCheck check(fmt::format("component '{}'", name), call.word, call.place, call.source);
    check.set_given({name, &value});
    Fields fields(check, value);
    ComponentEntry entry;
    entry.name = name;
    entry.place = call.place;
    read_record(fields, entry);
    const Value* calibration = fields.field("calibration");
    fields.done();
    if (auto ok = check.result(); !ok) return Unexpected(ok.error());
    if (fields.has("rate")) rate_places_[name] = check.place_of({"rate"});
    note_places(entry.places, check, {"config"}, entry.config);
    if (calibration != nullptr) {
        if (auto used = use_ros_calibration(call, check, *calibration, entry); !used) return Unexpected(used.error());
    }
    note_degrees(check, call, fmt::format("component '{}'", name), "yaw", entry.yaw);
    return entry;
}

Expected<void> SystemWords::connect(const WordCall& call, const Value& from, const Value& to) {
    ConnectionSpec connection;
    connection.place = call.place;
    const auto is_rtm = [](const Value& end) {
        return end.get_if<std::string>() != nullptr && is_rtm_path(*end.get_if<std::string>());
    };
    for (auto [value, out] : {std::pair{&from, &connection.from}, std::pair{&to, &connection.to}}) {
        const std::string* path = value->get_if<std::string>();
        if (is_rtm(*value)) {
            if (auto ok = rtm_path(*path); !ok) return failure("connect: " + ok.error().message, call.place);
        } else if (path == nullptr || !is_port_path(*path)) {
            const std::string got = path == nullptr ? nezumi::kind_of(*value) : "'" + *path + "'";
            return failure(fmt::format("connect: expected \"name.port\", got {}", got), call.place);
        }
        *out = *path;
    }
    if (is_rtm(from) && is_rtm(to)) {
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
    if (seed_place_)
        return failure(fmt::format("seed: is set already, at {}:{}", seed_place_->file, seed_place_->line), call.place);
    seed_place_ = call.place;
    spec_.seed = is_whole ? static_cast<std::uint64_t>(*number) : static_cast<std::uint64_t>(*whole);
    return {};
}

Expected<void> SystemWords::rate(const WordCall& call, const Value& hertz) {
    const auto value = number_of(hertz);
    if (!value || !std::isfinite(*value) || *value <= 0) {
        return failure(fmt::format("rate: expected a positive number of ticks a second, got {}",
                                   value ? text_of(*value) : nezumi::kind_of(hertz)),
                       call.place);
    }
    if (!spec_.rate_place.file.empty()) {
        return failure(fmt::format("rate: is set already, at {}:{}", spec_.rate_place.file, spec_.rate_place.line),
                       call.place);
    }
    spec_.rate_place = call.place;
    spec_.rate = *value;
    return {};
}

Expected<void> SystemWords::physics(const WordCall& call, const Value& value) {
    FieldCheck check("physics", call.word, call.place, call.source);
    check.set_given({"", &value});
    Fields fields(check, value);
    PhysicsFields given;
    read_record(fields, given);
    fields.done();
    if (auto ok = check.result(); !ok) return ok;
    if (physics_place_)
        return failure(fmt::format("physics: is set already, at {}:{}", physics_place_->file, physics_place_->line),
                       call.place);
    physics_place_ = call.place;
    spec_.physics_step = given.step;
    return {};
}

Expected<void> SystemWords::finish(bool is_part) const {
    for (const Begun& begun : begun_) {
        if (begun.complete) continue;
        return failure(fmt::format("{0} '{1}': expected a table after the name: {0} \"{1}\" {{ ... }}", begun.call.word,
                                   begun.name),
                       begun.call.place);
    }
    for (const Thing& thing : things_) {
        if (thing.placed) continue;
        return failure(fmt::format("{0}: is not in the arena: write arena {{ {0} ... }}", thing.call.word),
                       thing.call.place);
    }
    if (auto ok = check_arena(spec_.arena); !ok) return ok;  // what maps brought
    if (is_part) return {};
    if (auto ok = check_rates(); !ok) return ok;
    if (auto ok = check_lines(); !ok) return ok;
    if (auto ok = check_mazes(); !ok) return ok;
    for (const MarkerSpec& marker : spec_.arena.markers) {
        const auto taken = names_.find(marker.name);
        if (taken == names_.end()) continue;
        const Entry& other = spec_.entries[taken->second];
        return failure(fmt::format("marker '{}': the name is taken by the {} of {}:{}", marker.name, kind_of(other),
                                   place_of(other).file, place_of(other).line),
                       marker.place);
    }
    if (auto ok = check_network(); !ok) return ok;
    if (auto ok = check_rtm(); !ok) return ok;
    std::vector<std::string_view> robots;
    for (const Entry& entry : spec_.entries) {
        if (std::holds_alternative<RobotEntry>(entry)) robots.push_back(name_of(entry));
    }
    for (const Entry& entry : spec_.entries) {
        const auto* component = std::get_if<ComponentEntry>(&entry);
        if (component == nullptr || component->on.empty()) continue;
        if (std::find(robots.begin(), robots.end(), component->on) != robots.end()) continue;
        return failure(fmt::format("component '{}': field 'on' names no robot: there is none '{}'{}", component->name,
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

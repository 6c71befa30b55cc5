// A value has the same effect as in the system file, but its errors name the option as the location.
#include "bindings/lua/files/start_values.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <type_traits>
#include <variant>

#include "bindings/lua/files/data_file.hpp"
#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/files/robot_parameters.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "engine/base/number_in.hpp"

namespace nezumi {
namespace {

// The value of a text in quotes or of a table, evaluated by Lua.
Expected<Value> read_lua(const std::string& text, const Project& project, const std::string& shown) {
    auto file = DataFile::create(project, {});
    if (!file) return Unexpected(file.error());
    if (auto ran = (*file)->run("return " + text, shown, {}); !ran) return failure(ran.error().message);
    const auto value = read_file_value((*file)->lua(), -1);
    return value ? to_parameter(*value) : Expected<Value>(Unexpected(value.error()));
}

Entry* find_entry(SystemSpec& spec, std::string_view name) {
    const auto found = std::find_if(spec.entries.begin(), spec.entries.end(),
                                    [&](const Entry& entry) { return name_of(entry) == name; });
    return found == spec.entries.end() ? nullptr : &*found;
}

// A hint with the nearest entry that has parameters, or with all of them.
std::string nearest_entry(const SystemSpec& spec, std::string_view name) {
    std::vector<std::string_view> names;
    for (const Entry& entry : spec.entries) {
        if (!std::holds_alternative<RobotEntry>(entry)) names.emplace_back(name_of(entry));
    }
    std::string near = did_you_mean(name, names);
    if (!near.empty() || names.empty()) return near;
    constexpr std::size_t most = 10;
    const bool all = names.size() <= most;
    if (!all) names.resize(most);
    return fmt::format(" (those with parameters are {}{})", fmt::join(names, ", "), all ? "" : ", ...");
}

Expected<void> set_parameter(SystemSpec& spec, Entry& entry, const std::string& parameter, const Value& value,
                             const Place& place, const Project& project) {
    return std::visit(
        [&](auto& each) -> Expected<void> {
            using Kind = std::decay_t<decltype(each)>;
            if constexpr (std::is_same_v<Kind, RobotEntry>) {
                return set_robot_parameter(spec, each.name, parameter, value, place, project);
            } else {
                each.places["config." + parameter] = place;
                if constexpr (std::is_same_v<Kind, BehaviorEntry>) {
                    // The parameter set in use overrides `config`.
                    const auto used = each.sets.find(each.set);
                    if (used != each.sets.end() && used->second.contains(parameter)) used->second[parameter] = value;
                }
                each.config[parameter] = value;
                return {};
            }
        },
        entry);
}

// `name` may contain * and ?; then all components with matching names are set.
Expected<void> set_one(const std::string& text, SystemSpec& spec, const Project& project) {
    const std::string option = "--set " + shown(text);
    const Place place{.file = option};
    const auto equals = text.find('=');
    const auto dot = text.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot > equals || dot == 0 || dot + 1 == equals ||
        equals + 1 == text.size())
        return failure("expected COMPONENT.PARAMETER=VALUE as in controller.speed_x=0.3", place);
    const std::string name = text.substr(0, dot);
    const std::string parameter = text.substr(dot + 1, equals - dot - 1);
    auto value = read_option_value(text.substr(equals + 1), project, option);
    if (!value) return failure(value.error().message, place);
    bool found = false;
    for (Entry& entry : spec.entries) {
        if (fnmatch(name.c_str(), name_of(entry).c_str(), FNM_NOESCAPE) != 0) continue;
        found = true;
        if (auto ok = set_parameter(spec, entry, parameter, *value, place, project); !ok) return ok;
    }
    if (found) return {};
    return failure(fmt::format("{} has no component '{}'{}", spec.file, name, nearest_entry(spec, name)), place);
}

template <class AnEntry>
void take_config(AnEntry& entry, const AnEntry& from) {
    for (const auto& [parameter, value] : from.config) entry.config.insert_or_assign(parameter, value);
    for (const auto& [path, place] : from.places) entry.places.insert_or_assign(path, place);
}

Expected<void> take_file(const std::string& file, SystemSpec& spec, const Project& project, const PeerWords& words) {
    const auto saved = read_system_file(file, project, {.peer_words = words});
    if (!saved) return Unexpected(saved.error());
    for (const Entry& from : saved->entries) {
        Entry* const entry = find_entry(spec, name_of(from));
        const auto* behavior = std::get_if<BehaviorEntry>(&from);
        const auto* component = std::get_if<ComponentEntry>(&from);
        const auto* robot = std::get_if<RobotEntry>(&from);
        if (robot != nullptr && entry != nullptr && std::holds_alternative<RobotEntry>(*entry)) {
            if (auto ok = take_robot_parameters(spec, robot->name, *saved, *robot, project); !ok) return ok;
        }
        const bool says_nothing = behavior != nullptr    ? behavior->config.empty() && behavior->sets.empty()
                                  : component != nullptr ? component->config.empty()
                                                         : true;
        if (says_nothing) continue;
        const bool fits = entry != nullptr && entry->index() == from.index();
        if (!fits) {
            return failure(
                fmt::format("{} has no {} '{}'{}: --params needs a file that save has written for this system",
                            spec.file, behavior != nullptr ? "behavior" : "component", name_of(from),
                            nearest_entry(spec, name_of(from))),
                place_of(from));
        }
        if (behavior != nullptr) {
            auto& into = std::get<BehaviorEntry>(*entry);
            take_config(into, *behavior);
            into.sets = behavior->sets;
            into.set = behavior->set;
        } else {
            take_config(std::get<ComponentEntry>(*entry), *component);
        }
    }
    return {};
}

}  // namespace

Expected<Value> read_option_value(const std::string& text, const Project& project, const std::string& shown) {
    if (text == "true" || text == "false") return text == "true";
    if (const auto whole = number_in<std::int64_t>(text)) return *whole;
    if (const auto real = finite_in(text)) return *real;
    if (text.starts_with('{') || text.starts_with('"') || text.starts_with('\'')) return read_lua(text, project, shown);
    return text;
}

bool sets_argument(std::string_view text) {
    const auto equals = text.find('=');
    return equals != std::string_view::npos && equals > 0 && equals + 1 < text.size() &&
           text.substr(0, equals).find('.') == std::string_view::npos;
}

Expected<void> apply(const StartValues& values, SystemSpec& spec, const Project& project, const PeerWords& words) {
    if (!values.file.empty()) {
        if (auto ok = take_file(values.file, spec, project, words); !ok) return ok;
    }
    for (const std::string& text : values.set) {
        if (sets_argument(text)) continue;  // the file has used it already
        if (auto ok = set_one(text, spec, project); !ok) return ok;
    }
    return {};
}

}  // namespace nezumi

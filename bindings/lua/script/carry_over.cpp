// Compares values by name, and writes lines for the log.
#include "bindings/lua/script/carry_over.hpp"
#include "engine/values/value_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nezumi {
namespace {

// Gives a parameter the value that it has if no parameter set is in use: the value of the system file, or the default
// if there is none or it does not fit.
void follow_config(const Component& component, const std::string& name, Parameters& settings) {
    const auto given = component.configured.find(name);
    if (given == component.configured.end() || !settings.set(name, given->second)) settings.follow_default(name);
}

}  // namespace

bool same_values(const Parameters& one, const Parameters& other) {
    using Parameter = Parameters::Parameter;
    return std::ranges::equal(one.all(), other.all(), [](const Parameter& a, const Parameter& b) {
        return a.value == b.value && a.set == b.set && a.from_outside == b.from_outside &&
               a.from_within == b.from_within;
    });
}

void describe_lost(const Parameters& running, const Parameters& before, const Parameters& after,
                   std::vector<std::string>& warnings) {
    for (const auto& old : before.all()) {
        const auto* now = after.find(old.spec.name);
        if (now == nullptr) {
            const auto& its = *running.find(old.spec.name);
            if (its.set)
                warnings.push_back(
                    fmt::format("parameter '{}' and its value {} were removed", old.spec.name, lua_text(its.value)));
        } else if (old.set && !now->set) {
            warnings.push_back(
                fmt::format("parameter '{}': its value {} is no longer valid and was replaced by the default {}",
                            old.spec.name, lua_text(old.value), lua_text(now->value)));
        }
    }
}

std::string kept_text(const Parameters& before, const Parameters& after, const ParameterValues& configured) {
    constexpr std::size_t shown = 5;
    std::size_t count = 0;
    std::string text;
    for (const auto& now : after.all()) {
        const auto* old = before.find(now.spec.name);
        if (!now.set || old == nullptr || !old->set || now.value == now.spec.initial) continue;
        const auto given = configured.find(now.spec.name);
        const bool by_hand = given == configured.end() || check_value(now.spec, given->second) != now.value;
        if ((!by_hand && old->spec.initial == now.spec.initial) || ++count > shown) continue;
        text += fmt::format("{}{} = {} (its default is {})", text.empty() ? "" : ", ", now.spec.name,
                            lua_text(now.value), lua_text(now.spec.initial));
    }
    if (count > shown) text += fmt::format(" and {} more", count - shown);
    return text;
}

Expected<void> check_set(const Component& component, Parameters parameters) {
    const auto set = component.sets.find(component.set_in_use());
    return set == component.sets.end() ? Expected<void>() : parameters.set_all(set->second);
}

void leave_set(const Component& component, Parameters& settings) {
    for (const auto& [name, value] : component.sets.at(component.set_in_use())) {
        const auto* parameter = settings.find(name);
        if (parameter == nullptr || check_value(parameter->spec, value) != parameter->value) continue;
        follow_config(component, name, settings);
    }
}

void follow_use(const Component& component, const Parameters& running, bool with_own, Parameters& settings) {
    const auto in_use = component.sets.find(component.set_in_use());
    for (const auto& [set, values] : component.sets) {
        for (const auto& [name, value] : values) {
            const auto* now = running.find(name);
            if (now != nullptr && now->set && (with_own || now->from_outside)) continue;
            const bool is_used = in_use != component.sets.end() && in_use->second.contains(name);
            if (!is_used || !settings.set(name, in_use->second.at(name))) follow_config(component, name, settings);
        }
    }
}

void describe_dropped(const std::vector<Dropped>& dropped, std::vector<std::string>& warnings) {
    constexpr std::size_t shown = 10;
    for (std::size_t i = 0; i < dropped.size() && i < shown; ++i) {
        const bool kept = dropped[i].what.starts_with("a table with");
        warnings.push_back(
            fmt::format("{} is {}: {}", dropped[i].path, dropped[i].what,
                        kept ? "only its plain data was kept" : "it was dropped, state keeps plain data"));
    }
    if (dropped.size() > shown)
        warnings.push_back(fmt::format("and {} more such values of state", dropped.size() - shown));
}

}  // namespace nezumi

// Values that a scenario draws while it runs: s:any.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "bindings/scenario/search.hpp"
#include "engine/base/names.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {
// Draws values: those in the name of the run if it contains them, otherwise new ones from the seed of the run.
int ScenarioRun::Methods::any(ScenarioRun& run, lua_State* lua) {
    if (lua_type(lua, 2) != LUA_TSTRING)
        return raise(run, fmt::format("expected a name, as in s:any(\"gust\", {{ at = range(0, 10) }}), got {}",
                                      Arguments{lua}.kind(2)));
    const std::string name(string_at(lua, 2));
    if (!is_identifier(name))
        return raise(run, fmt::format("'{}' can't be the name of values: use letters, digits and _, no digit first",
                                      shown(name)));
    if (lua_type(lua, 3) != LUA_TTABLE)
        return raise(run, fmt::format("'{}': expected values, as in {{ at = range(0, 10) }}, got {}", name,
                                      Arguments{lua}.kind(3)));
    auto keys = read_sweep_keys(lua, 3, fmt::format("'{}'", name), condition_budget);
    if (!keys) return raise(run, keys.error().message);
    if (keys->empty())
        return raise(run, fmt::format("'{}': expected at least one value, as in {{ at = range(0, 10) }}", name));
    std::vector<std::pair<std::string, SweepValue>> values;
    for (SweepKey& key : *keys) {
        if (!is_identifier(key.name))
            return raise(run, fmt::format("'{}': expected a name for each value, got '{}'", name, shown(key.name)));
        const std::string field = key.name;
        key.name = fmt::format("{}.{}", name, field);
        const auto same = [&key](const auto& value) { return value.first == key.name; };
        const auto has_name = [&key](const DrawnValue& value) { return value.name == key.name; };
        if (std::any_of(run.result_.drawn.begin(), run.result_.drawn.end(), has_name))
            return raise(run, fmt::format("'{}': is drawn already: choose another name", name));
        const auto& point = run.settings_.point;
        const auto given = std::find_if(point.begin(), point.end(), same);
        const Sweep one{.keys = {key}, .samples = 1};
        auto drawn = given == point.end() ? std::optional(draw_point(one, mix(run.settings_.seed, key.name), 0))
                                          : find_point(one, fmt::format("[{}={}]", key.name, given->second.text));
        if (!drawn)
            return raise(run, fmt::format("'{}': '{}' can't have the value {}, which the name of the run gives", name,
                                          field, shown(given->second.text)));
        run.result_.drawn.push_back(drawn_values(one, *drawn).front());
        values.emplace_back(field, std::move(drawn->front().second));
    }
    const auto pushed = protect(lua, condition_budget, [&values](lua_State* inside) {
        lua_createtable(inside, 0, static_cast<int>(values.size()));
        for (const auto& [field, value] : values) {
            lua_pushlstring(inside, field.data(), field.size());
            push_plain(inside, value.data);
            lua_rawset(inside, -3);
        }
        return 1;
    });
    return pushed ? 1 : raise(run, pushed.error().message);
}

}  // namespace nezumi

// The words `scenario` and `range` of a scenario file, with strict checks of their arguments.
#include "bindings/scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/codec.hpp"
#include "bindings/scenario/method_scan.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi {
namespace {

// Keys of the registry: the table of functions, the metatable of ranges.
constexpr char functions_key = 0;
constexpr char range_key = 0;

constexpr double most_range_steps = 9007199254740992.0;  // 2^53: up to here, doubles hold all whole numbers

const SweepRange* to_range(lua_State* lua, int index) {
    if (lua_type(lua, index) != LUA_TUSERDATA || lua_getmetatable(lua, index) == 0) return nullptr;
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &range_key);
    const bool is_range = lua_rawequal(lua, -1, -2) != 0;
    lua_pop(lua, 2);
    return is_range ? static_cast<const SweepRange*>(lua_touserdata(lua, index)) : nullptr;
}

// The names of the fields of the table at `index` (absolute), read without metamethods; an error for any other key.
Expected<std::vector<std::string>> names_of(lua_State* lua, int index, std::string_view what) {
    std::vector<std::string> names;
    bool all_texts = true;
    for (lua_pushnil(lua); lua_next(lua, index) != 0; lua_pop(lua, 1)) {
        if (lua_type(lua, -2) != LUA_TSTRING) {
            all_texts = false;
        } else {
            names.emplace_back(detail::key_text(lua));
        }
    }
    if (!all_texts) return failure(fmt::format("{}: expected NAME = VALUE", what));
    std::sort(names.begin(), names.end());
    return names;
}

// Reads a range, or a list of plain data, at `values` on top of the stack.
Expected<SweepKey> read_values(lua_State* lua, int values, const std::string& name, const std::string& what,
                               const Budget& budget) {
    SweepKey key{name, {}};
    if (const SweepRange* range = to_range(lua, values)) {
        key.values = *range;
        return key;
    }
    if (lua_type(lua, values) != LUA_TTABLE)
        return failure(
            fmt::format("{} expected a list of values or range(lo, hi), got {}", what, Arguments{lua}.kind(values)));
    Mismatch why;
    const std::ptrdiff_t size = read_array_size(lua, values, &why);
    if (size < 1)
        return failure(fmt::format("{} expected a list of values, got {}", what,
                                   size == 0 ? "an empty one" : "a table with other keys than 1, 2, ..."));
    std::vector<SweepValue> list;
    for (std::ptrdiff_t i = 1; i <= size; ++i) {
        lua_rawgeti(lua, values, i);
        std::vector<Dropped> dropped;
        auto data = take_plain(lua, 1, budget, {"it"}, dropped);
        lua_pop(lua, 1);
        if (!data) return Unexpected(data.error());
        if (!dropped.empty())
            return failure(fmt::format("{}: value {} is not plain data: {}", what, i, dropped.front().what));
        SweepValue value = to_sweep_value(std::move(*data));
        if (!is_finite(value.data)) return failure(fmt::format("{} expected finite numbers, got {}", what, value.text));
        const auto called_so = [&value](const SweepValue& other) { return other.text == value.text; };
        if (const auto other = std::find_if(list.begin(), list.end(), called_so); other != list.end()) {
            if (*other == value) return failure(fmt::format("{} has the value {} twice", what, value.text));
            return failure(
                fmt::format("{} has two values that are both {} in the names of their runs", what, value.text));
        }
        list.push_back(std::move(value));
    }
    key.values = std::move(list);
    return key;
}

// Whether a run of the swept scenario `swept` has the same name as the scenario `other` without a sweep: "drives
// [speed=0.1]".
bool has_run_called(const Scenario& swept, const Scenario& other) {
    const std::string prefix = swept.name + " ";
    if (swept.sweep.keys.empty() || !other.sweep.keys.empty() || !other.name.starts_with(prefix)) return false;
    const std::string_view values = std::string_view(other.name).substr(prefix.size());
    const auto point = find_point(swept.sweep, values);
    return point && text_of(*point) == values;
}

std::string place_of(const Scenario& scenario) {
    return fmt::format("the scenario at {}:{}", scenario.place.file, scenario.place.line);
}

}  // namespace

Expected<void> check_paired(const Scenario& scenario, const std::string& name) {
    std::vector<std::string_view> lists;
    for (const SweepKey& key : scenario.sweep.keys) {
        if (!std::holds_alternative<std::vector<SweepValue>>(key.values)) continue;
        if (key.name == name) return {};
        lists.emplace_back(key.name);
    }
    return failure(fmt::format("the sweep has no list '{}'{}", shown(name), did_you_mean(name, lists)));
}

Expected<std::unique_ptr<ScenarioFile>> ScenarioFile::read(const std::filesystem::path& path,
                                                           const ScenarioFileOptions& options,
                                                           std::vector<Error>* errors) {
    Project project = Project::of(path, options.installed);
    if (options.project_files != nullptr) project = project.through(*options.project_files);
    std::string shown = project.shown(path);
    std::unique_ptr<ScenarioFile> file(
        new ScenarioFile(std::move(project), options.peer_words, std::move(shown), options.only));
    const auto give_up = [&](Error error) {
        if (errors != nullptr && errors->empty()) errors->push_back(error);
        return Unexpected(std::move(error));
    };
    auto text = options.text ? Expected<std::string>(*options.text) : read_whole(path, file->shown_);
    if (!text) return give_up(text.error());
    file->text_ = std::move(*text);
    auto data =
        DataFile::create(file->project_, {.seed = options.seed, .print = options.print, .coverage = options.coverage});
    if (!data) return give_up(data.error());
    file->file_ = std::move(*data);
    file->state().set_memory_limit(std::size_t{256} << 20);
    const auto opened = protect(file->file_->lua(), Budget{10}, [](lua_State* lua) {
        lua_newtable(lua);
        lua_rawsetp(lua, LUA_REGISTRYINDEX, &functions_key);
        lua_newtable(lua);
        lua_pushliteral(lua, "range");
        lua_setfield(lua, -2, "__name");
        lua_pushboolean(lua, 0);
        lua_setfield(lua, -2, "__metatable");
        lua_rawsetp(lua, LUA_REGISTRYINDEX, &range_key);
        return 0;
    });
    if (!opened) return give_up(file->file_->to_error(opened.error()));
    auto ran = file->file_->run(file->text_, file->shown_,
                                {{"scenario", scenario_word, file.get()}, {"range", range_word, file.get()}});
    if (!ran) {
        if (errors != nullptr) *errors = file->file_->errors();
        return give_up(ran.error());
    }
    if (file->scenarios_.empty()) {
        return give_up({"the file has no scenario: expected scenario(\"name\", function(s) ... end)", {file->shown_}});
    }
    if (!options.only) {
        if (auto ok = file->check_text(errors); !ok) return give_up(ok.error());
    }
    lua_settop(file->file_->lua(), 0);
    file->is_read_ = true;
    return file;
}

Expected<void> ScenarioFile::check_text(std::vector<Error>* errors) {
    if (const auto diagnostics = unknown_methods(text_, shown_, ScenarioRun::Methods::names(peer_words_));
        !diagnostics.empty()) {
        if (errors != nullptr) *errors = diagnostics;
        return Unexpected(diagnostics.front());
    }
    const DrawingScenarios drawing = find_drawing_scenarios(text_);
    for (Scenario& scenario : scenarios_) {
        scenario.draws = drawing.contain(scenario.place.line);
        if (scenario.search > 0 && scenario.sweep.keys.empty() && !scenario.draws)
            return Unexpected(
                Error{fmt::format("scenario '{}' has the option 'search', but nothing to search: add a sweep, or use "
                                  "s:any",
                                  nezumi::shown(scenario.name)),
                      scenario.place});
    }
    return {};
}

const std::string* ScenarioFile::text(const std::string& shown) const { return shown == shown_ ? &text_ : nullptr; }

void ScenarioFile::push_function(lua_State* lua, std::size_t scenario) const {
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &functions_key);
    lua_rawgeti(lua, -1, static_cast<lua_Integer>(scenario + 1));
    lua_remove(lua, -2);
}

Expected<void> ScenarioFile::noted(Expected<void> done) {
    if (!done) refused_ = done.error().message;
    return done;
}

int ScenarioFile::range_word(lua_State* lua) {
    SweepRange range;
    const auto read_range = [&]() -> Expected<void> {
        const Arguments arguments{lua};
        if (auto ok = arguments.at_most("range", 3, "(lo, hi, step)"); !ok) return ok;
        const bool stepped = arguments.has(3);
        const auto read = [lua](int index, double& out) {
            return lua_gettop(lua) >= index && detail::read_number(lua, index, 1e300, out, nullptr);
        };
        const bool fits = read(1, range.lo) && read(2, range.hi) && (!stepped || read(3, range.step));
        if (!fits) return failure("range: expected range(lo, hi) or range(lo, hi, step) with numbers");
        if (range.hi < range.lo || (stepped && !(range.step > 0)))
            return failure("range: expected lo <= hi, and a step above 0");
        if (stepped && !((range.hi - range.lo) / range.step < most_range_steps))
            return failure("range: the step is too small, its values would be equal: leave it out");
        range.whole = stepped && lua_isinteger(lua, 1) != 0 && lua_isinteger(lua, 3) != 0;
        return {};
    };
    auto& file = *static_cast<ScenarioFile*>(lua_touserdata(lua, lua_upvalueindex(1)));
    bridge(lua, [&] { return file.noted(read_range()); });
    *static_cast<SweepRange*>(lua_newuserdatauv(lua, sizeof(SweepRange), 0)) = range;
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &range_key);
    lua_setmetatable(lua, -2);
    return 1;
}

int ScenarioFile::scenario_word(lua_State* lua) {
    auto& file = *static_cast<ScenarioFile*>(lua_touserdata(lua, lua_upvalueindex(1)));
    luaL_checkstack(lua, 20, nullptr);
    bridge(lua, [&] { return file.noted(file.add(lua)); });
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &functions_key);
    lua_pushvalue(lua, lua_isfunction(lua, 2) ? 2 : 3);
    lua_rawseti(lua, -2, static_cast<lua_Integer>(file.scenarios_.size()));
    return 0;
}

Expected<void> ScenarioFile::add(lua_State* lua) {
    if (is_read_)
        return failure("scenario: a scenario can't declare another scenario: declare it at the top level of the file");
    if (only_ && *only_ != scenarios_.size()) {
        scenarios_.emplace_back();
        return {};
    }
    const Place place = calling_place(lua);
    auto scenario = read_call(lua, place);
    if (scenario) {
        named_.emplace(scenario->name, scenarios_.size());
        scenarios_.push_back(std::move(*scenario));
        return {};
    }
    Error error = scenario.error();
    if (error.place.file.empty()) error.place = place;
    return Unexpected(file_->fail(std::move(error)));
}

Expected<Scenario> ScenarioFile::read_call(lua_State* lua, const Place& place) {
    Scenario scenario;
    scenario.place = place;
    if (lua_type(lua, 1) != LUA_TSTRING) {
        return failure(fmt::format("scenario: expected a name, got {}", Arguments{lua}.kind(1)));
    }
    std::size_t length = 0;
    const char* name = lua_tolstring(lua, 1, &length);
    scenario.name.assign(name, length);
    const bool one_line =
        std::all_of(scenario.name.begin(), scenario.name.end(), [](unsigned char c) { return c >= 0x20 && c != 0x7f; });
    if (scenario.name.empty() || !one_line)
        return failure("scenario: expected a name of one line, without control characters");
    const std::string what = fmt::format("scenario '{}'", nezumi::shown(scenario.name));
    const bool has_options = !lua_isfunction(lua, 2);
    if (has_options && lua_type(lua, 2) != LUA_TTABLE && lua_type(lua, 2) > LUA_TNIL) {
        return failure(
            fmt::format("{}: expected options (a table) or a function, got {}", what, Arguments{lua}.kind(2)));
    }
    if (has_options && !lua_isfunction(lua, 3)) {
        return failure(fmt::format("{}: expected a function after the {}, got {}", what,
                                   lua_type(lua, 2) == LUA_TTABLE ? "options" : "name", Arguments{lua}.kind(3)));
    }
    if (lua_gettop(lua) > (has_options ? 3 : 2)) {
        return failure(
            fmt::format("{}: expected scenario(name, options, function), got {} arguments", what, lua_gettop(lua)));
    }
    if (auto ok = check_parameters(lua, has_options ? 3 : 2, 2); !ok)
        return failure(fmt::format("{}: the function gets the scenario and its values; {}", what, ok.error().message));
    if (const auto same = named_.find(scenario.name); same != named_.end())
        return failure(fmt::format("{}: the name is already used by {}", what, place_of(scenarios_[same->second])));
    if (has_options && lua_type(lua, 2) == LUA_TTABLE) {
        if (auto ok = read_options(lua, 2, scenario); !ok) return Unexpected(ok.error());
    }
    if (auto ok = check_names_of_runs(scenario); !ok) return Unexpected(ok.error());
    return scenario;
}

// The name must identify a run in results, folders of failures, and --filter. A file may have thousands of scenarios:
// only those whose names begin like a run of the other are compared.
Expected<void> ScenarioFile::check_names_of_runs(const Scenario& scenario) const {
    const std::string what = fmt::format("scenario '{}'", nezumi::shown(scenario.name));
    if (scenario.sweep.keys.empty()) {
        const std::string_view name = scenario.name;
        for (std::size_t end = name.find(" ["); end != std::string_view::npos; end = name.find(" [", end + 1)) {
            const auto swept = named_.find(name.substr(0, end));
            if (swept == named_.end() || !has_run_called(scenarios_[swept->second], scenario)) continue;
            return failure(
                fmt::format("{}: the name is already used by a run of {}", what, place_of(scenarios_[swept->second])));
        }
        return {};
    }
    const std::string begin = scenario.name + " [";
    for (auto other = named_.lower_bound(begin); other != named_.end() && other->first.starts_with(begin); ++other) {
        const Scenario& before = scenarios_[other->second];
        if (!has_run_called(scenario, before)) continue;
        return failure(fmt::format("{}: its run '{}' has the same name as {}", what, nezumi::shown(before.name),
                                   place_of(before)));
    }
    return {};
}

Expected<void> ScenarioFile::read_options(lua_State* lua, int index, Scenario& scenario) {
    std::int64_t samples = 0, seeds = 0, seed = 0, search = 0;
    const auto by_hand = [&](Fields& options) {
        const bool has_samples = options.whole("samples", samples, 1, static_cast<std::int64_t>(most_runs));
        const bool has_seeds = options.whole("seeds", seeds, 1, static_cast<std::int64_t>(most_runs));
        if (options.whole("seed", seed, 0, std::numeric_limits<std::int64_t>::max())) {
            scenario.seed = static_cast<std::uint64_t>(seed);
            if (has_seeds)
                options.check().explain({"seeds"}, "'seed' gives all runs the same seed: leave out 'seed' or 'seeds'");
        }
        if (options.whole("search", search, 1, static_cast<std::int64_t>(most_runs))) {
            const std::string_view why = "'search' chooses the runs: leave out one of these options";
            if (has_samples) options.check().explain({"samples"}, std::string(why));
            if (has_seeds) options.check().explain({"seeds"}, std::string(why));
            if (options.gives("paired")) options.check().explain({"paired"}, std::string(why));
        }
        if (!options.gives("sweep")) {
            if (has_samples) options.check().explain({"samples"}, "there is no sweep to draw from");
            return;
        }
        detail::push_raw_field(lua, index, "sweep");
        const auto swept = read_sweep(lua, lua_gettop(lua), scenario);
        lua_pop(lua, 1);
        if (!swept) options.check().wrong_at({"sweep"}, swept.error().message);
    };
    FieldCheck check(fmt::format("scenario '{}'", nezumi::shown(scenario.name)), "scenario", scenario.place,
                     file_->source(scenario.place.file), "option");
    check.set_given({scenario.name});
    if (auto ok = nezumi::read_options(lua, index, std::move(check), scenario, {}, by_hand); !ok) return ok;
    if (samples > 0) scenario.sweep.samples = static_cast<std::size_t>(samples);
    scenario.seeds = static_cast<std::size_t>(seeds);
    scenario.search = static_cast<std::size_t>(search);
    if (!scenario.paired.empty()) {
        if (auto ok = check_paired(scenario, scenario.paired); !ok)
            return failure(
                fmt::format("scenario '{}': option 'paired': {}", nezumi::shown(scenario.name), ok.error().message));
    }
    return {};
}

Expected<std::vector<SweepKey>> read_sweep_keys(lua_State* lua, int index, const std::string& what,
                                                const Budget& budget) {
    const auto names = names_of(lua, index, what);
    if (!names) return Unexpected(names.error());
    std::vector<SweepKey> keys;
    for (const std::string& name : *names) {
        detail::push_raw_field(lua, index, name);
        auto key = read_values(lua, lua_gettop(lua), name, fmt::format("{}: '{}'", what, nezumi::shown(name)), budget);
        if (!key) return Unexpected(key.error());
        lua_pop(lua, 1);
        keys.push_back(std::move(*key));
    }
    return keys;
}

Expected<void> ScenarioFile::read_sweep(lua_State* lua, int index, Scenario& scenario) {
    if (lua_type(lua, index) != LUA_TTABLE)
        return failure(fmt::format("option 'sweep' expected a table, as in {{ speed = {{ 0.1, 0.2 }} }}, got {}",
                                   Arguments{lua}.kind(index)));
    auto keys = read_sweep_keys(lua, index, "option 'sweep'", file_->budget());
    if (!keys) return Unexpected(keys.error());
    bool drawn = false;
    double runs = 1;
    for (const SweepKey& key : *keys) {
        const auto* list = std::get_if<std::vector<SweepValue>>(&key.values);
        drawn = drawn || list == nullptr;
        if (list != nullptr) runs *= static_cast<double>(list->size());
    }
    scenario.sweep.keys = std::move(*keys);
    if (drawn) {
        scenario.sweep.samples = default_samples;
    } else if (runs > static_cast<double>(most_runs)) {
        return failure(fmt::format("option 'sweep' makes {} runs, more than the limit of {}", runs, most_runs));
    }
    return {};
}

}  // namespace nezumi

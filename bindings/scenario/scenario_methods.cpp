// Finds and calls the methods of `s`. Contains the methods that let time pass.
#include "bindings/scenario/scenario_methods.hpp"
#include "bindings/lua/files/read_options.hpp"
#include "bindings/scenario/measures.hpp"
#include "bindings/scenario/method_scan.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "bindings/scenario/table_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/lua/sandbox/inspect.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

// The address is the key of the metatable of `s` in the registry.
constexpr char object_key = 0;

bool is_object(lua_State* lua, int index) {
    if (lua_type(lua, index) != LUA_TUSERDATA || lua_getmetatable(lua, index) == 0) return false;
    lua_rawgetp(lua, LUA_REGISTRYINDEX, &object_key);
    const bool same = lua_rawequal(lua, -1, -2) != 0;
    lua_pop(lua, 2);
    return same;
}

// Whether a method needs no world.
bool is_early(const std::vector<SystemWord>& words, std::string_view name) {
    constexpr std::string_view others[] = {"check", "near",     "equal", "measure", "now",
                                           "load",  "recorded", "judge", "any"};
    return std::find(std::begin(others), std::end(others), name) != std::end(others) ||
           std::any_of(words.begin(), words.end(), [&](const SystemWord& word) { return word.name == name; });
}

// Words of system files that have no effect in a scenario: `s.seed` is the seed of the run, and the sweep gives values.
bool is_of_files_alone(std::string_view word) { return word == "seed" || word == "argument"; }

// Whether a method lets time pass, or waits.
bool needs_time(std::string_view name) {
    constexpr std::string_view all[] = {"always", "never", "wait_until", "eventually", "maintain", "run"};
    return std::find(std::begin(all), std::end(all), name) != std::end(all);
}

}  // namespace

void ScenarioRun::Methods::push_object(lua_State* lua, ScenarioRun& run) {
    luaL_checkstack(lua, 20, nullptr);
    lua_newuserdatauv(lua, 0, 0);
    lua_newtable(lua);  // the metatable
    lua_pushlightuserdata(lua, &run);
    lua_newtable(lua);  // the methods
    add_system_words(lua, run.word_host_, true);
    for (const auto* methods : {&of_time(), &of_acts()}) {
        for (const Method& method : *methods) {
            lua_pushlightuserdata(lua, &run);
            lua_pushlightuserdata(lua, const_cast<Method*>(&method));
            lua_pushcclosure(lua, call, 2);
            lua_setfield(lua, -2, method.name);
        }
    }
    lua_pushcclosure(lua, index, 2);
    lua_setfield(lua, -2, "__index");
    lua_pushlightuserdata(lua, &run);
    lua_pushcclosure(lua, newindex, 1);
    lua_setfield(lua, -2, "__newindex");
    lua_pushboolean(lua, 0);
    lua_setfield(lua, -2, "__metatable");
    lua_pushliteral(lua, "scenario");
    lua_setfield(lua, -2, "__name");
    lua_pushvalue(lua, -1);
    lua_rawsetp(lua, LUA_REGISTRYINDEX, &object_key);
    lua_setmetatable(lua, -2);
}

std::vector<std::string_view> ScenarioRun::Methods::names(const PeerWords& peer_words) {
    std::vector<std::string_view> all{"hold", "inject", "release", "world"};
    for (const std::string_view name : system_word_names(peer_words)) {
        if (!is_of_files_alone(name)) all.push_back(name);
    }
    for (const Method& method : of_time()) all.emplace_back(method.name);
    for (const Method& method : of_acts()) all.emplace_back(method.name);
    std::sort(all.begin(), all.end());
    return all;
}

// Upvalue: the run.
int ScenarioRun::Methods::newindex(lua_State* lua) {
    auto& run = *static_cast<ScenarioRun*>(lua_touserdata(lua, lua_upvalueindex(1)));
    raise(run, "members of s can't be set: keep values in a local variable");
    note_diagnostic(run, lua);
    return raise_kept(lua);
}

// Upvalues: the run, the table of methods.
int ScenarioRun::Methods::index(lua_State* lua) {
    auto& run = *static_cast<ScenarioRun*>(lua_touserdata(lua, lua_upvalueindex(1)));
    luaL_checkstack(lua, 20, nullptr);
    const int answered = find_member(run, lua);
    if (answered == end_run) end_call(lua);
    if (answered != raise_text) return answered;
    note_diagnostic(run, lua);
    return raise_kept(lua);
}

// A wrong call of a method is a mistake of the scenario: the run counts as not possible, unless the scenario catches
// the error.
void ScenarioRun::Methods::note_diagnostic(ScenarioRun& run, lua_State* lua) {
    const std::string& text = run.file_.state().kept_error;
    if (!run.setup_error_ || text.find(run.setup_error_->message) == std::string::npos)
        run.setup_error_ = Error{one_line(text), calling_place(lua)};
}

int ScenarioRun::Methods::find_member(ScenarioRun& run, lua_State* lua) {
    if (run.stopped_) return end_run;
    if (lua_type(lua, 2) != LUA_TSTRING) return raise(run, "s: expected the name of a method or component");
    const std::string name(string_at(lua, 2));
    if (name == "seed") return lua_pushinteger(lua, static_cast<lua_Integer>(run.settings_.seed)), 1;
    lua_pushvalue(lua, 2);
    const bool is_method = lua_rawget(lua, lua_upvalueindex(2)) != LUA_TNIL && !is_of_files_alone(name);
    if (is_method && is_early(run.word_host_.all, name)) {
        run.described();
        return 1;
    }
    if (auto settled = run.settle_or_note(); !settled) return raise(run, describe(settled.error()));
    if (!run.has_world()) {
        const auto known = names(run.file_.peer_words());
        if (!is_method && name != "world") return raise(run, unknown_method("s", name, known));
        return raise(run, fmt::format("s.{}: there is no world yet: s:load a system, or use s:robot, s:behavior ...",
                                      shown(name)));
    }
    if (is_method) return 1;
    lua_pop(lua, 1);
    RunningSystem& world = run.current();
    if (name != "world" && world.system().find(name) == nullptr) {
        auto known = names(run.file_.peer_words());
        for (const auto& component : world.system().components()) known.emplace_back(component->name());
        return raise(run, unknown_method("s", name, known));
    }
    const auto pushed = protect(lua, condition_budget, [&](lua_State* inside) {
        if (name == "world") {
            run.objects_->push_system(inside, world);
        } else {
            run.objects_->push_component(inside, world, name);
        }
        return 1;
    });
    return pushed ? 1 : raise(run, pushed.error().message);
}

// Upvalues: the run, the method.
int ScenarioRun::Methods::call(lua_State* lua) {
    auto& run = *static_cast<ScenarioRun*>(lua_touserdata(lua, lua_upvalueindex(1)));
    const auto& method = *static_cast<const Method*>(lua_touserdata(lua, lua_upvalueindex(2)));
    luaL_checkstack(lua, 20, nullptr);
    const int answered = run.stopped_        ? end_run
                         : is_object(lua, 1) ? carry_out(run, lua, method)
                                             : raise(run, fmt::format("write s:{}(...) with a colon", method.name));
    if (answered == end_run || run.stopped_) end_call(lua);
    if (answered != raise_text) return answered;
    note_diagnostic(run, lua);
    return raise_kept(lua);
}

int ScenarioRun::Methods::carry_out(ScenarioRun& run, lua_State* lua, const Method& method) {
    if (run.sampling_ && needs_time(method.name))
        return raise(
            run,
            fmt::format(
                "{}: a condition can only read values: only the scenario itself can advance time or add expectations",
                method.name));
    if (auto ok = Arguments{lua, 2}.at_most(method.name, method.most, method.usage); !ok)
        return raise(run, ok.error().message);
    const int answered = method.function(run, lua);
    std::string& text = run.file_.state().kept_error;
    if (answered == raise_text && !text.starts_with(method.name)) text.insert(0, fmt::format("{}: ", method.name));
    return answered;
}

Expected<double> ScenarioRun::Methods::seconds(lua_State* lua, int index, std::string_view what,
                                               const double* otherwise) {
    if (lua_type(lua, index) <= LUA_TNIL && otherwise != nullptr) return *otherwise;
    double value = 0;
    Mismatch why;
    if (lua_type(lua, index) <= LUA_TNIL || !detail::read_number(lua, index, 1e9, value, &why) || value < 0) {
        return failure(fmt::format("{}{}expected seconds from 0 on, got {}", what, what.empty() ? "" : " ",
                                   lua_type(lua, index) == LUA_TNUMBER ? fmt::format("{}", number_at(lua, index))
                                                                       : Arguments{lua}.kind(index)));
    }
    return value;
}

// Ends the run with a failure that the scenario itself detected, at its line.
bool ScenarioRun::Methods::fails(ScenarioRun& run, lua_State* lua, std::string text) {
    Place place = calling_place(lua);
    if (place.file.empty()) place = run.scenario_.place;
    run.stop(RunOutcome::failed, {one_line(std::move(text)), std::move(place)});
    run.tell_ports(run.read_ports_);
    return false;
}

int ScenarioRun::Methods::expect(ScenarioRun& run, lua_State* lua, Expectation::Kind kind) {
    Expectation::Terms terms;
    terms.kind = kind;
    terms.place = calling_place(lua);
    if (lua_type(lua, 2) != LUA_TSTRING)
        return raise(run, fmt::format("expected a name (what should hold), got {}", Arguments{lua}.kind(2)));
    terms.name = one_line(std::string(string_at(lua, 2)));
    const bool has_options = lua_type(lua, 3) != LUA_TFUNCTION;
    const int function = has_options ? 4 : 3;
    if (has_options && lua_type(lua, 3) != LUA_TTABLE && lua_type(lua, 3) > LUA_TNIL)
        return raise(run, fmt::format("'{}': expected options (a table) or a function, got {}", terms.name,
                                      Arguments{lua}.kind(3)));
    if (lua_type(lua, function) != LUA_TFUNCTION)
        return raise(run, fmt::format("'{}': expected a function that returns true or false, got {}", terms.name,
                                      Arguments{lua}.kind(function)));
    const bool watches = kind == Expectation::Kind::always || kind == Expectation::Kind::never;
    if (has_options) {
        auto check = FieldCheck::of_options(fmt::format("'{}'", terms.name));
        if (auto ok = read_options(lua, 3, std::move(check), terms, {.kind = 1U << static_cast<unsigned>(kind)}); !ok)
            return raise(run, ok.error().message);
    } else if (kind == Expectation::Kind::maintain) {
        return raise(run, fmt::format("'{}': expected options with a 'hold', in seconds", terms.name));
    }
    if (lua_gettop(lua) > function)
        return raise(run, fmt::format("'{}': expected nothing after the function", terms.name));
    if (auto ok = check_parameters(lua, function, 0); !ok)
        return raise(run,
                     fmt::format("'{}': the function is called without arguments; {}", terms.name, ok.error().message));

    auto condition = Condition::take(lua, function, run.function_texts_);
    if (!condition) return raise(run, condition.error().message);
    auto watched =
        std::make_unique<Watched>(Watched{Expectation(std::move(terms), run.worlds_.now()), std::move(*condition)});
    auto& list = watches ? run.watches_ : run.waits_;
    list.push_back(std::move(watched));
    if (watches) return 0;
    {
        const CallPause pause;
        if (!run.wait(lua, *list.back())) return end_run;
    }
    lua_pushboolean(lua, 1);
    return 1;
}

int ScenarioRun::Methods::run_seconds(ScenarioRun& run, lua_State* lua) {
    const auto value = seconds(lua, 2, "", nullptr);
    if (!value) return raise(run, value.error().message);
    const CallPause pause;
    return run.pass_time(lua, *value) ? 0 : static_cast<int>(end_run);
}

// The message of a check is a text, or a number as Lua shows it.
std::optional<int> ScenarioRun::Methods::wrong_message(ScenarioRun& run, lua_State* lua, int index) {
    if (lua_isnoneornil(lua, index) || lua_isstring(lua, index) != 0) return std::nullopt;
    return raise(run, fmt::format("expected a message (a string), got {}", Arguments{lua}.kind(index)));
}

int ScenarioRun::Methods::check(ScenarioRun& run, lua_State* lua) {
    if (lua_gettop(lua) < 2) return raise(run, "expected a value");
    if (auto refused = wrong_message(run, lua, 3)) return *refused;
    if (lua_toboolean(lua, 2) != 0) return lua_pushvalue(lua, 2), 1;
    const bool is_told = !lua_isnoneornil(lua, 3);
    fails(run, lua, is_told ? fmt::format("check failed: {}", string_at(lua, 3)) : "check failed");
    return end_run;
}

int ScenarioRun::Methods::near(ScenarioRun& run, lua_State* lua) {
    double values[3]{};
    constexpr const char* names[] = {"the actual value", "the expected value", "the tolerance"};
    for (int i = 0; i < 3; ++i) {
        if (lua_type(lua, i + 2) != LUA_TNUMBER)
            return raise(run, fmt::format("expected {} (a number), got {}", names[i], Arguments{lua}.kind(i + 2)));
        values[i] = number_at(lua, i + 2);
    }
    const auto [actual, expected, tolerance] = values;
    if (!(tolerance >= 0)) return raise(run, fmt::format("expected a tolerance from 0 on, got {}", tolerance));
    if (auto refused = wrong_message(run, lua, 5)) return *refused;
    const double off = std::abs(actual - expected);
    if (off <= tolerance || actual == expected) return 0;  // equal infinities have no difference
    std::string text = fmt::format("near failed: {} is off {} by {:.6g}, more than the tolerance of {}", actual,
                                   expected, off, tolerance);
    if (std::isnan(actual) || std::isnan(expected))
        text = fmt::format("near failed: {} is not a number", names[std::isnan(actual) ? 0 : 1]);
    if (!lua_isnoneornil(lua, 5)) text += fmt::format(": {}", string_at(lua, 5));
    fails(run, lua, std::move(text));
    return end_run;
}

int ScenarioRun::Methods::equal(ScenarioRun& run, lua_State* lua) {
    if (lua_gettop(lua) < 3) return raise(run, "expected two values, the actual one and the expected one");
    if (auto refused = wrong_message(run, lua, 4)) return *refused;
    std::string where;
    {
        TableComparison comparison(lua);
        const auto answer = comparison.compare(2, 3);
        if (answer == TableComparison::Answer::equal) return 0;
        if (answer == TableComparison::Answer::too_deep)
            return raise(run, "the tables are nested too deeply to be compared");
        where = comparison.where();
    }
    const InspectOptions line{.width = 100'000, .text = 200};
    std::string text =
        fmt::format("equal failed: {} is not the expected {}", inspect(lua, 2, line), inspect(lua, 3, line));
    if (!where.empty()) text += fmt::format(" (they differ at {})", where);
    if (is_nan(lua, 2) || is_nan(lua, 3))
        text += " (nan is not equal to anything, not even to nan: to expect nan, write s:check(x ~= x))";
    if (!lua_isnoneornil(lua, 4)) text += fmt::format(": {}", string_at(lua, 4));
    fails(run, lua, std::move(text));
    return end_run;
}

int ScenarioRun::Methods::measure(ScenarioRun& run, lua_State* lua) {
    if (lua_type(lua, 2) != LUA_TSTRING)
        return raise(run, fmt::format("expected a name (what is measured), got {}", Arguments{lua}.kind(2)));
    Measure measure{.name = std::string(string_at(lua, 2))};
    const std::string what = fmt::format("'{}'", shown(measure.name));
    if (measure.name.empty() || one_line(measure.name) != measure.name)
        return raise(run, fmt::format("{}: expected a name of one line", what));
    if (is_column_of_measures(measure.name))
        return raise(run, fmt::format("{}: --measures has a column of this name: choose another", what));
    if (lua_type(lua, 3) != LUA_TNUMBER)
        return raise(run, fmt::format("{}: expected a number, got {}", what, Arguments{lua}.kind(3)));
    measure.value = number_at(lua, 3);
    if (!std::isfinite(measure.value))
        return raise(run, fmt::format("{}: expected a finite number, got {}", what, measure.value));
    if (lua_type(lua, 4) > LUA_TNIL && lua_type(lua, 4) != LUA_TSTRING)
        return raise(run, fmt::format("{}: expected a unit as in \"s\", got {}", what, Arguments{lua}.kind(4)));
    if (lua_type(lua, 4) == LUA_TSTRING) measure.unit = one_line(std::string(string_at(lua, 4)));
    const auto same = [&](const Measure& other) { return other.name == measure.name; };
    const auto& taken = run.result_.measures;
    const auto before = std::find_if(taken.begin(), taken.end(), same);
    if (before != taken.end())
        return raise(run, fmt::format("{}: is already measured, as {}: a run keeps one number for each name", what,
                                      before->value));
    run.result_.measures.push_back(std::move(measure));
    return 0;
}

int ScenarioRun::Methods::now(ScenarioRun& run, lua_State* lua) {
    lua_pushnumber(lua, run.worlds_.now());
    return 1;
}

const std::vector<ScenarioRun::Methods::Method>& ScenarioRun::Methods::of_time() {
    using Kind = Expectation::Kind;
    static const std::vector<Method> methods{
        {"always", expect_as<Kind::always>, 3, "(name, function)"},
        {"never", expect_as<Kind::never>, 3, "(name, function)"},
        {"wait_until", expect_as<Kind::wait_until>, 3, "(name, options, function)"},
        {"eventually", expect_as<Kind::eventually>, 3, "(name, options, function)"},
        {"maintain", expect_as<Kind::maintain>, 3, "(name, options, function)"},
        {"run", run_seconds, 1, "(seconds)"},
        {"check", check, 2, "(value, message)"},
        {"near", near, 4, "(actual, expected, tolerance, message)"},
        {"equal", equal, 3, "(actual, expected, message)"},
        {"measure", measure, 3, "(name, value, unit)"},
        {"now", now, 0, "()"},
        {"any", any, 2, "(name, { at = range(0, 10), ... })"},
    };
    return methods;
}

}  // namespace nezumi

// Acts of a scenario on its worlds: load, reload, faults.
#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <utility>

#include "bindings/lua/files/file_value.hpp"
#include "bindings/lua/files/find_script.hpp"
#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/live/robot_acts.hpp"
#include "bindings/lua/values/codec.hpp"
#include "bindings/scenario/failure_folder.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "bindings/scenario/scenario_methods.hpp"
#include "engine/ports/setting.hpp"
#include "engine/project/writable_folder.hpp"
#include "engine/robot/robot.hpp"
#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

constexpr double for_ever = std::numeric_limits<double>::infinity();

// Keys of faults. The address of the system distinguishes worlds.
std::string key_of(const RunningSystem* live, std::string_view name) {
    return fmt::format("{} {}", fmt::ptr(live), name);
}

std::string_view text_or_empty(lua_State* lua, int index) {
    if (lua_type(lua, index) != LUA_TSTRING) return {};
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, index, &length);
    return {text, length};
}

Expected<ActResult> act_on(RunningSystem* live, const Act& what) { return live->act(what, scenario_actor); }

// The act that puts the present override of a port into effect again.
Act act_of(Override kind, const std::string& path, const Port& port) {
    switch (kind) {
        case Override::held: return Hold{path, port.override_value()};
        case Override::dropped: return Drop{path};
        case Override::frozen: return Freeze{path};
        case Override::none: break;
    }
    return Release{path};
}

// An act for a later time; its target may be gone by then.
std::function<void()> later(RunningSystem* live, Act what) {
    return [live, what = std::move(what)] { static_cast<void>(act_on(live, what)); };
}

// Each run of a sweep, or of several seeds, has its own golden: "stop.csv" becomes "stop-speed=0.1.csv". `run` is the
// part of the run's name after the name of the scenario.
std::string golden_name(const std::filesystem::path& file, std::string_view run) {
    if (run.empty()) return file.string();
    return file.parent_path() / (run_file_name(file.filename(), run, true) + file.extension().string());
}

}  // namespace

int ScenarioRun::Methods::load(ScenarioRun& run, lua_State* lua) {
    if (lua_type(lua, 2) != LUA_TSTRING)
        return raise(run, "expected the name of a system file, as in s:load \"systems/stop_at_wall.lua\"");
    if (auto loaded = run.load(std::string(text_or_empty(lua, 2)), read_file_value(lua, 3), calling_place(lua));
        !loaded) {
        run.setup_error_ = loaded.error();
        run.setup_error_->message = one_line(run.setup_error_->message);
        return raise(run, describe(*run.setup_error_));
    }
    const auto pushed = protect(lua, condition_budget, [&run](lua_State* inside) {
        run.objects_->push_system(inside, run.current());
        return 1;
    });
    return pushed ? 1 : raise(run, pushed.error().message);
}

int ScenarioRun::Methods::golden(ScenarioRun& run, lua_State* lua) {
    if (lua_type(lua, 2) != LUA_TSTRING) return raise(run, "expected the name of a CSV file beside the scenario file");
    const std::string name = golden_name(text_or_empty(lua, 2), run.values());
    GoldenOptions options;
    const bool has_options = lua_type(lua, 3) == LUA_TTABLE;
    if (has_options) {
        auto check = FieldCheck::of_options(fmt::format("'{}'", name));
        if (auto ok = read_options(lua, 3, std::move(check), options); !ok) return raise(run, ok.error().message);
    }
    std::vector<const Channel*> channels;
    for (int index = has_options ? 4 : 3; index <= lua_gettop(lua); ++index) {
        const auto at = run.objects_->to_port(lua, index);
        if (!at) return raise(run, fmt::format("'{}': {}", name, at.error().message));
        channels.push_back(at->live->trace().follow(at->path()).value());
    }
    if (channels.empty()) return raise(run, fmt::format("'{}': expected ports after the name", name));
    if (run.current().options().build.real_time)
        return raise(run,
                     fmt::format("'{}': two runs of a real robot always differ: use this only in simulation", name));
    Place place = calling_place(lua);
    auto file = (std::filesystem::path(place.file).parent_path() / name).lexically_normal();
    const auto home = writable_folder(run.file_.project(), place.file);
    if (auto ok = check_is_within(home, file, name, "a golden"); !ok) return raise(run, ok.error().message);
    for (const GoldenUse& other : run.result_.goldens) {
        if (other.file != file) continue;
        return raise(run, fmt::format("'{}' is already used by the golden at {}:{}: choose another name", name,
                                      other.place.file, other.place.line));
    }
    run.result_.goldens.push_back({file.string(), place});
    run.goldens_.emplace_back(std::move(file), name, options.tolerance, std::move(place), channels);
    return 0;
}

int ScenarioRun::Methods::reload(ScenarioRun& run, lua_State* lua) {
    const auto at = run.objects_->to_component(lua, 2);
    if (!at) return raise(run, at.error().message);
    const ScriptFile* script = at->component->script_file();
    if (script == nullptr)
        return raise(run, fmt::format("{} has no script: only behaviours can be reloaded", at->component->name()));
    ReloadOptions source;
    if (auto ok = read_options(lua, 3, FieldCheck::of_options("reload"), source); !ok)
        return raise(run, ok.error().message);
    if (source.file.has_value() == source.text.has_value())
        return raise(run, "expected { file = \"NAME\" } or { text = \"...\" }");
    Reload reload{.component = at->component->name(), .shown = script->shown, .text = source.text.value_or("")};
    Expected<ActResult> report = failure("");
    bool readable = true;
    if (source.file) {
        const auto path = find_script(run.file_.project(), *source.file, calling_place(lua).file);
        auto read =
            path ? run.file_.project().read_source(path->string()) : Expected<SourceText>(Unexpected(path.error()));
        readable = read.has_value();
        if (readable) {
            reload.text = std::move(read->text);
            reload.shown = read->shown;
        } else {
            report = Unexpected(read.error());
        }
    }
    if (readable) {
        const CallPause pause;
        report = at->live->act(reload, scenario_actor);
    }
    const std::string message = report ? fmt::format("version {} runs", report->version) : describe(report.error());
    const bool ok = report.has_value();
    const auto pushed = protect(lua, condition_budget, [&](lua_State* inside) {
        lua_pushboolean(inside, ok ? 1 : 0);
        lua_pushlstring(inside, message.data(), message.size());
        return 2;
    });
    return pushed ? 2 : raise(run, pushed.error().message);
}

int ScenarioRun::Methods::act_on_port(ScenarioRun& run, lua_State* lua, std::string_view word) {
    const auto done = run.objects_->act_on_port(lua, 2, word);
    return done ? 0 : raise(run, done.error().message);
}

int ScenarioRun::Methods::port_fault(ScenarioRun& run, lua_State* lua, Override kind) {
    const auto at = run.objects_->to_port(lua, 2);
    if (!at) return raise(run, at.error().message);
    const auto duration = seconds(lua, 3, "the duration", &for_ever);
    if (!duration) return raise(run, duration.error().message);
    const std::string path = at->path();
    const std::string key = key_of(at->live, path);
    const Override before = at->port->override();
    const Act restored = act_of(before, path, *at->port);
    const Act fault = act_of(kind, path, *at->port);
    if (auto done = act_on(at->live, fault); !done) return raise(run, done.error().message);
    // If the port is now held or free, a hold or release has replaced its earlier faults.
    if (before == Override::held || before == Override::none) run.faults_.forget(key);
    if (before != Override::none && !run.faults_.has(key)) run.faults_.lies_under(key, later(at->live, restored));
    const auto is_there = [live = at->live, path, kind] {
        const auto port = live->system().port(path);
        return port && (*port)->override() == kind;
    };
    run.faults_.begin(key, run.worlds_.now(), *duration,
                      {.put = later(at->live, fault), .undo = later(at->live, Release{path}), .is_there = is_there});
    return 0;
}

// Ends a hold. If the port is dropped or frozen, ends the hold below that.
int ScenarioRun::Methods::release(ScenarioRun& run, lua_State* lua) {
    if (const auto at = run.objects_->to_port(lua, 2)) {
        const std::string key = key_of(at->live, at->path());
        const Override kind = at->port->override();
        if (kind != Override::held && kind != Override::none && run.faults_.has(key)) {
            if (run.faults_.forget_under(key)) return 0;
            return raise(run, fmt::format("{} is {}, not held: to end that, use s:restore", at->path(), to_text(kind)));
        }
    }
    return act_on_port(run, lua, "release");
}

int ScenarioRun::Methods::disturb(ScenarioRun& run, lua_State* lua) {
    const auto at = run.objects_->to_component(lua, 2);
    if (!at) return raise(run, at.error().message);
    if (lua_type(lua, 3) != LUA_TTABLE)
        return raise(run,
                     "expected a table " + usage_of<VelocityConstraint>(Describe<VelocityConstraint>::in_scenarios));
    double duration = for_ever;
    if (detail::push_raw_field(lua, 3, "seconds")) {
        const auto value = seconds(lua, lua_gettop(lua), "field 'seconds'", nullptr);
        lua_pop(lua, 1);
        if (!value) return raise(run, value.error().message);
        duration = *value;
    }
    const auto constraint = read_velocity_constraint(lua, 3, Describe<VelocityConstraint>::in_scenarios);
    if (!constraint) return raise(run, constraint.error().message);
    const std::string name = at->component->name();
    const Disturb fault{name, constraint->vx, constraint->vy, constraint->va};
    if (auto ok = act_on(at->live, fault); !ok) return raise(run, ok.error().message);
    run.faults_.begin(key_of(at->live, name + " disturb"), run.worlds_.now(), duration,
                      {.put = later(at->live, fault), .undo = later(at->live, Disturb{name})});
    return 0;
}

int ScenarioRun::Methods::press(ScenarioRun& run, lua_State* lua) {
    const auto at = run.objects_->to_component(lua, 2);
    if (!at) return raise(run, at.error().message);
    if (lua_type(lua, 3) != LUA_TSTRING) return raise(run, "expected the name of a button or touch sensor");
    const std::string sensor(text_or_empty(lua, 3));
    const auto duration = seconds(lua, 4, "the duration", &for_ever);
    if (!duration) return raise(run, duration.error().message);
    const std::string name = at->component->name();
    const Press fault{name, sensor, true};
    if (auto ok = act_on(at->live, fault); !ok) return raise(run, ok.error().message);
    run.faults_.begin(key_of(at->live, name + " press " + sensor), run.worlds_.now(), *duration,
                      {.put = later(at->live, fault), .undo = later(at->live, Press{name, sensor, false})});
    return 0;
}

int ScenarioRun::Methods::teleport(ScenarioRun& run, lua_State* lua) {
    const auto teleport = read_teleport(*run.objects_, run.current(), lua, 2, 3);
    if (!teleport) return raise(run, teleport.error().message);
    const auto done = teleport->live->act(teleport->act, scenario_actor);
    return done ? 0 : raise(run, done.error().message);
}

int ScenarioRun::Methods::act(ScenarioRun& run, const Act& act) {
    const auto done = run.current().act(act, scenario_actor);
    return done ? 0 : raise(run, done.error().message);
}

int ScenarioRun::Methods::restore(ScenarioRun& run, lua_State* lua) {
    if (const auto component = run.objects_->to_component(lua, 2)) {
        if (dynamic_cast<const Robot*>(component->component) == nullptr)
            return raise(run, fmt::format("{} is not a robot: expected a robot, or a port as in \"{}.NAME\"",
                                          component->component->name(), component->component->name()));
        // Ends presses, forced velocities and the faults of its ports.
        run.faults_.restore(key_of(component->live, component->component->name()));
        for (const auto& port : component->component->in_ports())
            run.faults_.restore(key_of(component->live, component->component->name() + "." + port->name()));
        for (const auto& port : component->component->out_ports())
            run.faults_.restore(key_of(component->live, component->component->name() + "." + port->name()));
        return 0;
    }
    // A name without a dot is the name of a component.
    if (lua_type(lua, 2) == LUA_TSTRING && text_or_empty(lua, 2).find('.') == std::string_view::npos)
        return raise(run, run.objects_->to_component(lua, 2).error().message);
    const auto at = run.objects_->to_port(lua, 2);
    if (!at) return raise(run, at.error().message);
    run.faults_.restore(key_of(at->live, at->path()));
    const auto done = at->live->act(Release{at->path()}, scenario_actor);
    return done ? 0 : raise(run, done.error().message);
}

int ScenarioRun::Methods::allow_error(ScenarioRun& run, lua_State* lua) {
    const auto at = run.objects_->to_component(lua, 2);
    if (!at) return raise(run, at.error().message);
    run.allowed_errors_.emplace(at->live, at->component->name());
    return 0;
}

const std::vector<ScenarioRun::Methods::Method>& ScenarioRun::Methods::of_acts() {
    static const std::vector<Method> methods{
        {"load", load, 2, "(file, { robots = { NAME = { ... } } })"},
        {"recorded", recorded, 2, "(file, { map = { TOPIC = \"component.port\" } })"},
        {"judge", judge, 1, "{ behavior =, component =, run =, map =, tolerance = }"},
        {"golden", golden, 250, "(name, options, port, ...)"},
        {"reload", reload, 2, "(component, { file = } or { text = })"},
        {"inject", [](ScenarioRun& run, lua_State* lua) { return act_on_port(run, lua, "inject"); }, 2,
         "(port, value)"},
        {"hold", [](ScenarioRun& run, lua_State* lua) { return act_on_port(run, lua, "hold"); }, 3,
         "(port, value, { take = true })"},
        {"release", release, 1, "(port)"},
        {"drop", [](ScenarioRun& run, lua_State* lua) { return port_fault(run, lua, Override::dropped); }, 2,
         "(port, seconds)"},
        {"freeze", [](ScenarioRun& run, lua_State* lua) { return port_fault(run, lua, Override::frozen); }, 2,
         "(port, seconds)"},
        {"disturb", disturb, 2,
         fmt::format("(robot, {})", usage_of<VelocityConstraint>(Describe<VelocityConstraint>::in_scenarios))},
        {"press", press, 3, "(robot, sensor, seconds)"},
        {"teleport", teleport, 2, "(robot, pose)"},
        {"restore", restore, 1, "(thing)"},
        {"allow_error", allow_error, 1, "(component)"},
        {"stop", [](ScenarioRun& run, lua_State*) { return act(run, Stop{}); }, 0, "()"},
        {"rearm", [](ScenarioRun& run, lua_State*) { return act(run, Rearm{}); }, 0, "()"},
    };
    return methods;
}

}  // namespace nezumi

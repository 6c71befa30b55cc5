// One C function runs all commands. After a wrong call, it first destroys all C++ objects, and then raises the Lua
// error.
#include "bindings/console/console_commands.hpp"
#include "bindings/lua/live/object_core.hpp"
#include "bindings/lua/sandbox/slices.hpp"
#include "bindings/lua/values/codec.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace nezumi {
namespace {

enum class Outcome : unsigned char { done, number, value, table, waits, failed };

// Waits until the ticks of a command have passed, and detects if another user changes time meanwhile.
class Wait {
public:
    explicit Wait(Session::Parts& parts)
        : parts_(parts), start_(parts.live.generation()), end_(parts.live.system().now().tick + parts.ticks) {
        parts.clock.advance(parts.ticks);
        parts.moves = parts.clock.moves();
    }

    bool is_over() const { return is_here() || is_taken_over() || !parts_.clock.is_advancing(); }
    Expected<void> end() const {
        if (is_here() || !is_taken_over()) return {};
        return failure("interrupted: another console has stopped, moved or restarted time");
    }

private:
    bool is_here() const { return parts_.live.generation() == start_ && parts_.live.system().now().tick == end_; }
    bool is_taken_over() const { return parts_.live.generation() != start_ || parts_.clock.moves() != parts_.moves; }

    Session::Parts& parts_;
    int start_;
    std::int64_t end_;
};

// Runs a command between two ticks, and lets time pass if it waits.
Expected<CommandEnd> run(Session::Parts& parts, const ConsoleCommand& command, const Arguments& arguments) {
    if (command.beside) return command.run(parts, arguments);
    Expected<CommandEnd> end = failure("interrupted");
    std::optional<Wait> wait;
    parts.worker.perform([&] {
        if (!wait) {
            end = command.run(parts, arguments);
            if (!end || *end != CommandEnd::wait) return true;
            wait.emplace(parts);
            if (!Worker::has_thread) {  // the input pauses, and calls this to see if the wait is over
                parts.waits = [wait = *wait] { return wait.is_over() ? std::optional(wait.end()) : std::nullopt; };
                return true;
            }
        }
        parts.waiting = !wait->is_over();
        if (parts.waiting) return false;
        if (auto ended = wait->end(); !ended) end = Unexpected(ended.error());
        return true;
    });
    return end;
}

Outcome run_command(lua_State* L, Session::Parts& parts, const ConsoleCommand& command) {
    const Arguments arguments{L};
    const std::string_view name = command.name;
    if (auto ok = arguments.at_most(name, command.most, std::string_view(command.usage).substr(name.size())); !ok) {
        keep_error(L, ok.error().message);
        return Outcome::failed;
    }
    const Expected<CommandEnd> end = run(parts, command, arguments);
    if (!end) {
        keep_error(L, fmt::format("{}: {}", name, describe(end.error())));
        return Outcome::failed;
    }
    if (*end == CommandEnd::wait && parts.waits) return Outcome::waits;
    if (*end == CommandEnd::table) return Outcome::table;
    if (*end == CommandEnd::value) return Outcome::value;
    return *end == CommandEnd::number ? Outcome::number : Outcome::done;
}

int call_with_table(lua_State* L);

// Whether a paused input may continue. An error is stored with `keep_error`.
Outcome end_wait(lua_State* L, Session::Parts& parts) {
    const auto ended = parts.waits();
    parts.waiting = !ended;
    if (!ended) return Outcome::waits;
    parts.waits = nullptr;
    if (*ended) return Outcome::done;
    keep_error(L, describe(ended->error()));
    return Outcome::failed;
}

int go_on_waiting(lua_State* L, int /*status*/, lua_KContext /*context*/) {
    switch (end_wait(L, parts_of(L))) {
        case Outcome::done: return 0;
        case Outcome::failed: return raise_kept(L);
        default: return pause(L, 0, go_on_waiting);
    }
}

int begin_waiting(lua_State* L) {
    if (can_pause(L)) return go_on_waiting(L, LUA_OK, 0);
    return luaL_error(L,
                      "a web page can't wait for ticks inside this function: call the command directly in the input");
}

// The Lua function of each command. Upvalues: the parts, the number of the command.
int call_command(lua_State* L) {
    Session::Parts& parts = parts_of(L);
    const auto number = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(2)));
    switch (run_command(L, parts, console_commands()[number])) {
        case Outcome::done: return 0;
        case Outcome::number: lua_pushnumber(L, parts.number); return 1;
        case Outcome::value: detail::push_any(L, parts.value); return 1;
        case Outcome::table:
            lua_pushvalue(L, lua_upvalueindex(1));
            lua_pushvalue(L, lua_upvalueindex(2));
            lua_pushvalue(L, 1);
            lua_pushcclosure(L, call_with_table, 3);
            return 1;
        case Outcome::waits: return begin_waiting(L);
        case Outcome::failed: return raise_kept(L);
    }
    return 0;
}

// The function that `robot "mouse"` returns: takes the table and runs the command with name and table. Upvalues: those
// of the command, and the name.
int call_with_table(lua_State* L) {
    lua_pushvalue(L, lua_upvalueindex(3));
    lua_insert(L, 1);
    return call_command(L);
}

// The command of one of these two functions, from its second upvalue.
const ConsoleCommand& command_of(lua_State* L, int index) {
    lua_getupvalue(L, index, 2);
    const auto number = static_cast<std::size_t>(lua_tointeger(L, -1));
    lua_pop(L, 1);
    return console_commands()[number];
}

}  // namespace

const std::vector<ConsoleCommand>& console_commands() {
    static const std::vector<ConsoleCommand> commands{
        {"ls",
         "ls() or ls(component) or ls \"rtm:\"",
         "lists components, connections and holds; with \"rtm:\" the components in OpenRTM's name service",
         1,
         command_ls,
         true,
         {Offer::component}},
        {"find", "find \"vel\"", "lists ports, parameters and commands whose name or description contains this", 1,
         command_find, true},
        {"watch",
         "watch(port)",
         "shows a port's value whenever it changes",
         1,
         command_watch,
         false,
         {Offer::any_port}},
        {"unwatch",
         "unwatch(port) or unwatch()",
         "ends one watch, or all watches, plots and breakpoints",
         1,
         command_unwatch,
         false,
         {Offer::any_port}},
        {"plot",
         "plot(port, ..., seconds, { every = 1 })",
         "draws the values of the last seconds, also \"mouse.truth.pose.heading\"; every: seconds between two drawings",
         18,
         command_plot,
         true,
         {Offer::any_port},
         {"plot_options", 2}},
        {"samples",
         "samples(port, since, most)",
         "gives the values after `since` as a table: labels, and rows of a stamp and values",
         3,
         command_samples,
         false,
         {Offer::port}},
        {"explain",
         "explain(component)",
         "shows its next execution, or the one that failed: inputs, executed lines, outputs, the motion of the robots",
         1,
         command_explain,
         true,
         {Offer::component}},
        {"break_at", "break_at(\"keeper.lua:12\", function(locals) return locals.d > 3 end)",
         "pauses time after a tick that ran this line, if the function returns true, and shows the execution", 2,
         command_break_at, true},
        {"watch_changes",
         "watch_changes(controller.out.vx)",
         "shows every change of a value, with its time",
         1,
         command_watch_changes,
         false,
         {Offer::port}},
        {"profile",
         "profile(seconds, component)",
         "measures what each component costs in the next seconds, and each line of this behaviour",
         2,
         command_profile,
         false,
         {Offer::nothing, Offer::component}},
        {"inject",
         "inject(port, value)",
         "sends one message to a port, as from a connection",
         2,
         command_inject,
         true,
         {Offer::port, Offer::value}},
        {"hold",
         "hold(port, value, { take = true })",
         "sends this value every tick; nothing else gets through",
         3,
         command_hold,
         true,
         {Offer::port, Offer::value, Offer::nothing},
         {"hold_options", 3}},
        {"release", "release(port)", "ends hold", 1, command_release, true, {Offer::port}},
        {"connect",
         "connect(from, to)",
         "connects an out-port to an in-port",
         2,
         command_connect,
         true,
         {Offer::source, Offer::target}},
        {"disconnect",
         "disconnect(from, to) or disconnect(port)",
         "ends one connection, or all of a port",
         2,
         command_disconnect,
         true,
         {Offer::port, Offer::in_port}},
        {"behavior",
         "behavior \"NAME\" { script = ... }",
         "adds a behaviour to the running system, as in a system file",
         2,
         command_behavior,
         true,
         {Offer::nothing},
         {"behavior", 2}},
        {"component",
         "component \"NAME\" { type = ... }",
         "adds a native component",
         2,
         command_component,
         true,
         {Offer::nothing},
         {"component", 2}},
        {"robot",
         "robot \"NAME\" { model = ... }",
         "adds a simulated robot",
         2,
         command_robot,
         true,
         {Offer::nothing},
         {"robot", 2}},
        {"marker",
         "marker { name = ..., id = ... }",
         "adds a marker",
         1,
         command_marker,
         true,
         {Offer::nothing},
         {"marker", 1}},
        {"remove",
         "remove \"NAME\"",
         "removes a component or marker, and its connections",
         1,
         command_remove,
         false,
         {Offer::removable}},
        {"activate",
         "activate() or activate(component)",
         "activates one component, or all INACTIVE ones",
         1,
         command_activate,
         true,
         {Offer::component}},
        {"deactivate",
         "deactivate() or deactivate(component)",
         "deactivates one component, or all ACTIVE ones",
         1,
         command_deactivate,
         true,
         {Offer::component}},
        {"rtm", "rtm(name, \"activate\") or rtm(name, { speed = 0.5 })",
         "another program's RTC: activate, deactivate, reset, exit, forget, use a set, set values; rtm(name) shows it",
         3, command_rtm, true},
        {"drive",
         "drive \"stick\"",
         "drives a robot with the arrow keys, until Esc",
         1,
         command_drive,
         false,
         {Offer::component}},
        {"teleport",
         "teleport(\"target\", { x = 1 })",
         "moves a marker, a robot, or \"box 2\" to a pose",
         2,
         command_teleport,
         false,
         {Offer::carried, Offer::nothing}},
        {"stop", "stop()", "emergency stop: robots brake and ignore commands until rearm()", 0, command_stop},
        {"rearm", "rearm()", "ends an emergency stop when the robots stand: they obey new commands", 0, command_rearm},
        {"pause", "pause()", "pauses time; run() continues", 0, command_pause},
        {"step", "step(n)", "lets n ticks pass, then pauses", 1, command_step},
        {"run", "run(seconds) or run()", "runs for this many seconds, then pauses; run() does not pause", 1,
         command_run},
        {"speed",
         "speed(factor)",
         "sets how fast time passes: 1 is real time, \"max\" is as fast as possible",
         1,
         command_speed,
         false,
         {Offer::max}},
        {"resume",
         "resume() or resume { live = true }",
         "time continues; in the past, the rest of the run is repeated; live: comes back to the present first",
         1,
         command_resume,
         true,
         {},
         {"resume_options", 1}},
        {"rewind", "rewind(seconds)", "goes back in time by this many seconds, and pauses", 1, command_rewind, true},
        {"seek", "seek(12.3) or seek(\"main\", 12.3)", "goes to this time, or to the end of a branch, and pauses", 2,
         command_seek, true},
        {"branches", "branches()", "lists the branches of this run: a change in the past starts a new branch", 0,
         command_branches},
        {"restart",
         "restart() or restart \"anyway\"",
         "reads the system file again and starts at time 0",
         1,
         command_restart,
         true,
         {Offer::anyway}},
        {"reload", "reload()", "loads every script that has changed", 0, command_reload, true},
        {"rollback",
         "rollback() or rollback(component)",
         "goes back to the previous version",
         1,
         command_rollback,
         false,
         {Offer::component}},
        {"errors", "errors()", "lists components in ERROR, and the last warnings and errors", 0, command_errors},
        {"log_level",
         "log_level \"debug\"",
         "shows the log from this level on: debug, info, warn, error",
         1,
         command_log_level,
         false,
         {Offer::log_level}},
        {"save", "save \"system.lua\"", "writes the present wiring and configuration as a system file", 1, command_save,
         true},
        {"new", "new \"NAME\" { inputs = ..., outputs = ..., params = ..., callbacks = ..., doc = ... }",
         "writes a new behaviour and a scenario for it into the project, as nezumi new does", 2, command_new, true},
        {"picture", "picture \"x.png\"", "draws the arena and the robots from above, as .png or .svg", 1,
         command_picture, true},
        {"graph", "graph \"wiring.svg\"", "draws components, ports and connections, as .svg or .png", 1, command_graph,
         true},
        {"now", "now()", "shows the simulated time", 0, command_now},
        {"print", "print(...)", "prints values", 250, command_print, true},
        {"help",
         "help() or help \"step\" or help(component)",
         "explains commands, components, ports, parameters and members",
         1,
         command_help,
         true,
         {Offer::topic}},
        {"quit", "quit()", "ends the run", 0, command_quit},
        {"exit", "exit()", "the same as quit()", 0, command_quit},
    };
    return commands;
}

const ConsoleCommand* find_console_command(std::string_view name) {
    for (const ConsoleCommand& command : console_commands()) {
        if (command.name == name) return &command;
    }
    return nullptr;
}

void add_console_commands(lua_State* L, Session::Parts& parts) {
    luaL_checkstack(L, 6, nullptr);
    lua_Integer number = 0;
    for (const ConsoleCommand& command : console_commands()) {
        lua_pushlightuserdata(L, &parts);
        lua_pushinteger(L, number++);
        lua_pushcclosure(L, call_command, 2);
        lua_setfield(L, -2, command.name);
    }
}

const ConsoleCommand* command_at(lua_State* L, int index) {
    return lua_tocfunction(L, index) == call_command && lua_checkstack(L, 1) != 0 ? &command_of(L, index) : nullptr;
}

std::string waiting_command_at(lua_State* L, int index) {
    if (lua_tocfunction(L, index) != call_with_table || lua_checkstack(L, 1) == 0) return "";
    lua_getupvalue(L, index, 3);
    const std::string name = shown(text_at(L, -1));
    lua_pop(L, 1);
    return fmt::format("{} \"{}\"", command_of(L, index).name, name);
}

}  // namespace nezumi

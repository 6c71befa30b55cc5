// The commands of the console: name, usage, help text, and arguments.
#pragma once

#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/console/session_parts.hpp"
#include "bindings/lua/values/bridge.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// How a command ends, and what follows.
enum class CommandEnd : unsigned char {
    done,
    number,  ///< the command returns `Parts::number`
    value,   ///< the command returns `Parts::value`
    table,   ///< the command got only a name; it returns a function that takes the table: `robot "mouse" { ... }`
    wait,    ///< the input continues when `Parts::ticks` ticks have passed
};

/// What completion offers for an argument of a command.
enum class Offer : unsigned char {
    nothing,
    component,
    port,
    any_port,   ///< a port, also one of another host
    source,     ///< an out-port, also one of another host
    target,     ///< an in-port of the type of the first argument, also one of another host
    in_port,    ///< an in-port of that type, only of this system
    value,      ///< the fields of a message of the port in the argument before
    carried,    ///< what `teleport` can move: a marker, a robot, or a thing such as "box 1"
    removable,  ///< a component or marker
    log_level,
    anyway,  ///< the text "anyway"
    max,     ///< the text "max"
    topic,   ///< a name that `help` explains
};

struct ConsoleCommand {
    const char* name;
    const char* usage;  ///< "step(n)": it begins with the name
    const char* help;   ///< one sentence
    int most;           ///< maximum number of arguments
    Expected<CommandEnd> (*run)(Session::Parts& parts, const Arguments& arguments);
    /// True: it runs in the thread of the session while ticks go on, and asks the ticking thread for what it needs of
    /// the system. False: it runs between two ticks, so it must not read large values from Lua.
    bool beside = false;
    std::vector<Offer> offers{};  ///< for its arguments, in order; the last offer is also for all further arguments
    /// The name of the record in `file_records` or `console_records` that describes its table, and the first argument
    /// that may be this table.
    struct Table {
        std::string_view record{};
        int from = 1;
    } table{};
};

/// The command of this name, or null.
const ConsoleCommand* find_console_command(std::string_view name);

/// All commands, in the order of `help()`.
const std::vector<ConsoleCommand>& console_commands();

/// Adds the functions of all commands to the table on top of the stack. May raise a Lua error.
void add_console_commands(lua_State* L, Session::Parts& parts);
/// The command whose function is at `index`; null for any other value.
const ConsoleCommand* command_at(lua_State* L, int index);

/// The levels that `log_level` accepts, most verbose first.
std::vector<std::string> log_level_names();

/// If the value was returned by a command that still needs its table, the text of this command, as in
/// `robot "mouse"`; "" for any other value.
std::string waiting_command_at(lua_State* L, int index);

/// The result of a command that performed one act and shows nothing.
template <class Result>
Expected<CommandEnd> done(const Expected<Result>& acted) {
    if (!acted) return Unexpected(acted.error());
    return CommandEnd::done;
}

/// The name after "rtm:" if the argument is such a text.
std::optional<std::string> peer_named(const Arguments& arguments, int position);
/// The name of a value, from an argument as `plot` takes it: `controller.out.vx`, a port, or a text.
Expected<std::string> name_of_value(Session::Parts& parts, const Arguments& arguments, int position);
/// Computes the execution in which a behaviour failed once more, in a copy of the system, and shows it.
Expected<CommandEnd> explain_failure(Session::Parts& parts, const std::string& name);
/// Sends a request to components of other programs, waits for the answer, and shows it. For commands that run beside
/// the ticks.
Expected<CommandEnd> ask_peers(Session::Parts& parts, const PeerRequest& request);

// Each group has its own file.
using CommandFunction = Expected<CommandEnd>(Session::Parts&, const Arguments&);
CommandFunction command_connect, command_disconnect;                                                 // wiring
CommandFunction command_behavior, command_component, command_robot, command_marker, command_remove;  // members
CommandFunction command_activate, command_deactivate, command_log_level;                             // life
CommandFunction command_ls, command_find, command_help, command_errors, command_now, command_print;  // looking
CommandFunction command_watch, command_unwatch, command_plot, command_drive, command_explain;        // following
CommandFunction command_samples;
CommandFunction command_break_at, command_watch_changes, command_profile;  // looking into executions
CommandFunction command_inject, command_hold, command_release;             // acting
CommandFunction command_teleport, command_stop, command_rearm;
CommandFunction command_pause, command_step, command_run, command_speed, command_restart, command_quit;  // time
CommandFunction command_seek, command_rewind, command_resume, command_branches;                          // the past
CommandFunction command_reload, command_rollback;                                                        // versions
CommandFunction command_rtm;                                                // other programs
CommandFunction command_save, command_new, command_picture, command_graph;  // files

}  // namespace nezumi

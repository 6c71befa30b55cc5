// Checks and implements the globals of tasks. A wait function leaves the execution, and continues in a later one.
#include "bindings/lua/script/task_globals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/sandbox/slices.hpp"
#include "bindings/lua/script/declaration_fields.hpp"
#include "bindings/lua/script/script_call.hpp"

namespace nezumi {
namespace {

Expected<std::string> task_name(lua_State* L, std::string_view function) {
    if (lua_type(L, 1) == LUA_TSTRING) return Arguments{L}.text(1, "");
    return failure(fmt::format("{} expected a task's name, got {}", function, Arguments{L}.kind(1)));
}

// task(name, fn, { repeating = })
int global_task(lua_State* L) {
    Script& script = script_of(L);
    const int function = keep_function(L);
    declare(L, script, [&]() -> Expected<void> {
        if (auto ok = Arguments{L}.at_most("task", 3, "(name, function, options)"); !ok) return ok;
        auto name = task_name(L, "task");
        if (!name) return Unexpected(name.error());
        Task task{.name = std::move(*name), .function = function, .place = caller(L)};
        const std::string title = fmt::format("task '{}'", shown(task.name));
        if (function == LUA_NOREF)
            return failure(fmt::format("{}: expected a function, got {}", title, Arguments{L}.kind(2)));
        if (auto ok = check_parameters(L, 2, 0); !ok) return failure(fmt::format("{}: {}", title, ok.error().message));
        if (auto ok = read_options(L, 3, FieldCheck::of_options(title), task.options); !ok) return ok;
        return script.declare_task(std::move(task));
    });
    return 0;
}

// start(name)
int global_start(lua_State* L) {
    Script& script = script_of(L);
    return bridge(L, [&]() -> Expected<void> {
        if (auto ok = Arguments{L}.at_most("start", 1, "(name)"); !ok) return ok;
        const auto name = task_name(L, "start");
        if (!name) return Unexpected(name.error());
        if (auto ok = script.check_tasks_run("start"); !ok) return ok;
        return script.tasks().start(*name, script.seconds());
    });
}

Expected<void> check_can_wait(lua_State* L, const Tasks& tasks, std::string_view function) {
    if (tasks.closes())
        return failure(fmt::format(
            "{} can't be called here: the task is being ended, and code that closes its variables can't wait",
            function));
    if (tasks.current() == nullptr)
        return failure(fmt::format("{} can only be called in a task: task(\"name\", function() ... end)", function));
    if (can_pause(L)) return {};
    return failure(fmt::format(
        "{} can't be called here: a function that Lua's library calls (as table.sort does) can't wait", function));
}

int never_goes_on(lua_State*, int, lua_KContext) { return 0; }

// cancel(name). If a task cancels itself, this call does not return.
int global_cancel(lua_State* L) {
    Script& script = script_of(L);
    Task* task = nullptr;
    bridge(L, [&]() -> Expected<void> {
        if (auto ok = Arguments{L}.at_most("cancel", 1, "(name)"); !ok) return ok;
        const auto name = task_name(L, "cancel");
        if (!name) return Unexpected(name.error());
        if (auto ok = script.check_tasks_run("cancel"); !ok) return ok;
        auto found = script.tasks().find_active(*name);
        if (!found) return Unexpected(found.error());
        task = *found;
        if (task == nullptr || task != script.tasks().current()) return {};
        return check_can_wait(L, script.tasks(), "cancel");
    });
    if (task != nullptr && task == script.tasks().current()) {
        task->ends = true;
        return pause(L, 0, never_goes_on);
    }
    if (task != nullptr) script.tasks().cancel(L, *task, script.seconds());
    lua_pushboolean(L, task != nullptr ? 1 : 0);
    return 1;
}

void begin_wait(lua_State* L, Script& script, double seconds, bool for_condition) {
    Task& task = *script.tasks().current();
    task.waiter = L;
    task.line = caller(L).line;
    task.seconds = seconds;
    task.for_condition = for_condition;
    task.since = script.seconds();
}

// A coroutine that has waited can continue only in its task. After the end of the task it can only be closed.
Expected<void> check_turn(lua_State* L, const Script& script) {
    const Task* task = script.tasks().current();
    if (task != nullptr && task->waiter == L) return {};
    return failure("this coroutine can't continue: the task in which it waited has ended");
}

int go_on_wait(lua_State* L, int, lua_KContext) {
    Script& script = script_of(L);
    bridge(L, [&] { return check_turn(L, script); });
    lua_pushnumber(L, script.seconds() - script.tasks().current()->since);
    return 1;
}

// wait(seconds) -> seconds
int global_wait(lua_State* L) {
    Script& script = script_of(L);
    bridge(L, [&]() -> Expected<void> {
        if (auto ok = Arguments{L}.at_most("wait", 1, "(seconds)"); !ok) return ok;
        const auto seconds = Arguments{L}.number(1, "seconds");
        if (!seconds) return failure("wait " + seconds.error().message);
        if (!std::isfinite(*seconds) || *seconds < 0)
            return failure(fmt::format("wait expected finite seconds of at least 0, got {}", *seconds));
        if (auto ok = check_can_wait(L, script.tasks(), "wait"); !ok) return ok;
        begin_wait(L, script, *seconds, false);
        return {};
    });
    return pause(L, 0, go_on_wait);
}

// The condition is at index 1.
int check_condition(lua_State* L, int, lua_KContext) {
    Script& script = script_of(L);
    bridge(L, [&] { return check_turn(L, script); });
    lua_settop(L, 1);
    lua_pushvalue(L, 1);
    lua_call(L, 0, 1);
    const bool holds = lua_toboolean(L, -1) != 0;
    const Task& task = *script.tasks().current();
    if (!holds && !has_passed(task.seconds, task.since, script.seconds())) return pause(L, 0, check_condition);
    lua_pushboolean(L, holds ? 1 : 0);
    return 1;
}

// wait_until(condition, { within = }) -> whether it holds
int global_wait_until(lua_State* L) {
    Script& script = script_of(L);
    bridge(L, [&]() -> Expected<void> {
        if (auto ok = Arguments{L}.at_most("wait_until", 2, "(condition, options)"); !ok) return ok;
        if (lua_type(L, 1) != LUA_TFUNCTION)
            return failure(fmt::format("wait_until expected a function, got {}", Arguments{L}.kind(1)));
        if (auto ok = check_parameters(L, 1, 0); !ok) return failure("wait_until: " + ok.error().message);
        WaitOptions options;
        if (auto ok = read_options(L, 2, FieldCheck::of_options("wait_until"), options); !ok) return ok;
        if (auto ok = check_can_wait(L, script.tasks(), "wait_until"); !ok) return ok;
        begin_wait(L, script, options.within, true);
        return {};
    });
    return check_condition(L, LUA_OK, 0);
}

struct GlobalFunction {
    const char* name;
    lua_CFunction function;
};
constexpr GlobalFunction task_functions[] = {{"task", global_task},
                                             {"start", global_start},
                                             {"cancel", global_cancel},
                                             {"wait", global_wait},
                                             {"wait_until", global_wait_until}};

}  // namespace

bool is_task_global(std::string_view name) {
    return std::any_of(std::begin(task_functions), std::end(task_functions),
                       [&](const GlobalFunction& each) { return each.name == name; });
}

void set_task_globals(lua_State* L, Script& script) {
    // Raw access, because the metatable of the globals refuses new globals.
    for (const GlobalFunction& each : task_functions) {
        lua_pushstring(L, each.name);
        lua_pushlightuserdata(L, &script);
        lua_pushcclosure(L, each.function, 1);
        lua_rawset(L, -3);
    }
}

}  // namespace nezumi

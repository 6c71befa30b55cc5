// Decides which task runs when. Functions that take a Lua state may raise errors, so they contain no objects with
// destructors.
#include "bindings/lua/script/tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bindings/lua/sandbox/line_trace.hpp"
#include "bindings/lua/sandbox/slices.hpp"

namespace nezumi {
namespace {

bool is_under_way(const Task& task) {
    return task.status == Task::Status::ready || task.status == Task::Status::running ||
           task.status == Task::Status::waiting;
}

void set_status(Task& task, Task::Status status, double now) {
    task.status = status;
    task.since = now;
}

// "1.5 s, 0.7 s are left", "a condition".
std::string waiting_text(const Task& task, double now) {
    const std::string left = fmt::format("{:.3g} s are left", std::max(0.0, task.since + task.seconds - now));
    if (!task.for_condition) return fmt::format("{:.6g} s, {}", task.seconds, left);
    return std::isfinite(task.seconds) ? "a condition, " + left : "a condition";
}

}  // namespace

std::string_view to_text(Task::Status status) {
    constexpr std::string_view names[] = {"inactive", "ready", "running", "waiting", "finished", "cancelled", "failed"};
    return names[static_cast<int>(status)];
}

Expected<void> Tasks::declare(Task task) {
    if (const Task* other = find(task.name)) {
        return failure(fmt::format("task '{}' is declared twice (first in line {})", task.name, other->place.line));
    }
    tasks_.push_back(std::move(task));
    return {};
}

std::string Tasks::names() const {
    std::string text;
    for (const Task& task : tasks_) text += (text.empty() ? "" : ", ") + task.name;
    return text;
}

Task* Tasks::find(std::string_view name) {
    const auto found = std::find_if(tasks_.begin(), tasks_.end(), [&](const Task& task) { return task.name == name; });
    return found == tasks_.end() ? nullptr : &*found;
}

Expected<Task*> Tasks::known(std::string_view name) {
    if (Task* task = find(name)) return task;
    return failure(fmt::format("unknown task '{}'{}", shown(name), did_you_mean(name, tasks_, &Task::name)));
}

void Tasks::start_all(double now) {
    for (Task& task : tasks_) set_status(task, Task::Status::ready, now);
}

Expected<void> Tasks::start(std::string_view name, double now) {
    const auto task = known(name);
    if (!task) return Unexpected(task.error());
    if (is_under_way(**task)) return failure(fmt::format("task '{}' is already running", name));
    set_status(**task, Task::Status::ready, now);
    return {};
}

Expected<Task*> Tasks::find_active(std::string_view name) {
    const auto task = known(name);
    if (!task) return Unexpected(task.error());
    return is_under_way(**task) ? *task : nullptr;
}

void Tasks::run(lua_State* L, double now) {
    for (Task& task : tasks_) {
        if (task.status == Task::Status::ready) {
            begin(L, task);
        } else if (task.status != Task::Status::waiting ||
                   (!task.for_condition && !has_passed(task.seconds, task.since, now))) {
            continue;
        }
        run_slice_of(L, task, now);
    }
}

void Tasks::begin(lua_State* L, Task& task) {
    luaL_checkstack(L, 4, nullptr);
    task.thread = lua_newthread(L);
    lua_rawgeti(task.thread, LUA_REGISTRYINDEX, task.function);
    task.anchor = luaL_ref(L, LUA_REGISTRYINDEX);
}

void Tasks::run_slice_of(lua_State* L, Task& task, double now) {
    task.status = Task::Status::running;
    current_ = &task;
    LineTrace::follow(task.thread);
    const SliceEnd end = run_slice(L, task.thread);
    current_ = nullptr;
    switch (end) {
        case SliceEnd::failed:
            set_status(task, Task::Status::failed, now);
            lua_error(L);
            break;
        case SliceEnd::returned:
            forget(L, task);
            set_status(task, task.options.repeating ? Task::Status::ready : Task::Status::finished, now);
            break;
        case SliceEnd::paused:
            if (task.ends) return cancel(L, task, now);
            task.status = Task::Status::waiting;
            break;
    }
}

void Tasks::forget(lua_State* L, Task& task) {
    luaL_unref(L, LUA_REGISTRYINDEX, task.anchor);
    task.anchor = LUA_NOREF;
    task.thread = task.waiter = nullptr;
    task.ends = false;
}

void Tasks::cancel(lua_State* L, Task& task, double now) {
    lua_State* const thread = task.thread;
    set_status(task, Task::Status::cancelled, now);
    if (thread == nullptr) return;                   // the task has not begun to run
    lua_rawgeti(L, LUA_REGISTRYINDEX, task.anchor);  // kept until its to-be-closed variables are closed
    forget(L, task);
    if (!close_slices(L, thread, closes_)) lua_error(L);
    lua_pop(L, 1);
}

void Tasks::end(lua_State* L, double now) {
    lua_settop(L, 1);
    current_ = nullptr;
    ends_ = true;
    bool well = true;
    for (Task& task : tasks_) {
        // If the status is still `running`, the time limit has stopped the task.
        const bool failed = task.status == Task::Status::failed || task.status == Task::Status::running;
        lua_State* const thread = task.thread;
        if (is_under_way(task) || failed) set_status(task, failed ? Task::Status::failed : Task::Status::inactive, now);
        if (thread == nullptr) continue;
        lua_rawgeti(L, LUA_REGISTRYINDEX, task.anchor);
        forget(L, task);
        const bool closed = close_slices(L, thread, closes_);
        if (!closed && well) lua_replace(L, 1);  // the first error; index 1 is reserved for it
        well = well && closed;
        lua_settop(L, 1);
    }
    if (!well) lua_error(L);
    ends_ = false;
    lua_settop(L, 0);
}

std::vector<TaskStatus> Tasks::status(double now) const {
    std::vector<TaskStatus> all;
    for (const Task& task : tasks_) {
        TaskStatus status{.name = task.name, .status = std::string(to_text(task.status)), .since = task.since};
        if (task.status == Task::Status::waiting) {
            status.waiting = waiting_text(task, now);
            status.line = task.line;
        }
        all.push_back(std::move(status));
    }
    return all;
}

}  // namespace nezumi

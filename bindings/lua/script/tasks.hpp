// The tasks of a script: what it does one after the other, in coroutines that wait across executions.
#pragma once

#include <deque>
#include <limits>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/inside.hpp"

namespace nezumi {

/// The last argument of `task(name, fn, { ... })`.
struct TaskOptions {
    bool repeating = false;  ///< begins again at the execution after the one in which it has ended
};

/// The last argument of `wait_until(fn, { ... })`.
struct WaitOptions {
    double within = std::numeric_limits<double>::infinity();  ///< [s] after which it gives up
};

/// One task.
struct Task {
    enum class Status : unsigned char { inactive, ready, running, waiting, finished, cancelled, failed };

    std::string name;
    int function = LUA_NOREF;
    TaskOptions options;
    Place place;

    Status status = Status::inactive;
    double since = 0;             ///< [s] when it got this status
    lua_State* thread = nullptr;  ///< its coroutine, while `anchor` keeps it
    int anchor = LUA_NOREF;

    // While it waits.
    lua_State* waiter = nullptr;  ///< its coroutine, or one that runs in it: whose call waits
    int line = 0;                 ///< of that call
    double seconds = 0;           ///< [s] how long at most; may be infinite for a condition
    bool for_condition = false;
    bool ends = false;  ///< it has cancelled itself
};

std::string_view to_text(Task::Status status);

class Tasks {
public:
    Expected<void> declare(Task task);
    const std::deque<Task>& all() const { return tasks_; }
    bool empty() const { return tasks_.empty(); }
    /// The names, for messages: "patrol, search".
    std::string names() const;
    /// The task whose slice runs; null when none does.
    Task* current() const { return current_; }
    /// Whether what a task has open is being closed.
    bool closes() const { return closes_; }
    /// Whether `end` has failed, or runs.
    bool ends() const { return ends_; }

    /// All begin at the next execution. None may be under way.
    void start_all(double now);
    /// Begins a task at the next execution: an error while it is under way, and where there is none of this name.
    Expected<void> start(std::string_view name, double now);
    /// The task of this name that may be cancelled; null when it is not under way.
    Expected<Task*> find_active(std::string_view name);

    // What is called within a protected call and may raise a Lua error.

    /// Runs a slice of each that has something to do, in the order of their declarations.
    void run(lua_State* L, double now);
    /// Ends one: what it has open is closed.
    void cancel(lua_State* L, Task& task, double now);
    /// Ends all, as on deactivation. `L` has an empty stack.
    void end(lua_State* L, double now);

    /// All as they are, in the order of their declarations.
    std::vector<TaskStatus> status(double now) const;

private:
    void begin(lua_State* L, Task& task);
    void run_slice_of(lua_State* L, Task& task, double now);
    static void forget(lua_State* L, Task& task);
    Task* find(std::string_view name);
    Expected<Task*> known(std::string_view name);

    std::deque<Task> tasks_;  // stay where they are
    Task* current_ = nullptr;
    bool closes_ = false;  // while closers run
    bool ends_ = false;
};

/// Whether `seconds` have passed from `since` to `now`, but for what rounding may have taken off.
inline bool has_passed(double seconds, double since, double now) { return now - since >= seconds - 1e-9; }

}  // namespace nezumi

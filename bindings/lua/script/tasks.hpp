// The tasks of a script: coroutines that run one step after the other and wait across executions.
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
    bool repeating = false;  ///< starts again at the execution after its end
};

/// The last argument of `wait_until(fn, { ... })`.
struct WaitOptions {
    double within = std::numeric_limits<double>::infinity();  ///< [s] the longest time to wait
};

/// One task.
struct Task {
    enum class Status : unsigned char { inactive, ready, running, waiting, finished, cancelled, failed };

    std::string name;
    int function = LUA_NOREF;
    TaskOptions options;
    Place place;

    Status status = Status::inactive;
    double since = 0;             ///< [s] time of the last change of status
    lua_State* thread = nullptr;  ///< its coroutine; `anchor` protects it from the garbage collector
    int anchor = LUA_NOREF;

    // While it waits.
    lua_State* waiter = nullptr;  ///< its coroutine, or one within it, that called the wait function
    int line = 0;                 ///< of this call
    double seconds = 0;           ///< [s] maximum time; may be infinite for a condition
    bool for_condition = false;
    bool ends = false;  ///< the task has cancelled itself
};

std::string_view to_text(Task::Status status);

class Tasks {
public:
    Expected<void> declare(Task task);
    const std::deque<Task>& all() const { return tasks_; }
    bool empty() const { return tasks_.empty(); }
    /// The names for messages: "patrol, search".
    std::string names() const;
    /// The running task; null if none runs.
    Task* current() const { return current_; }
    /// Whether to-be-closed variables of a task are being closed now.
    bool closes() const { return closes_; }
    /// Whether `end` runs or has failed.
    bool ends() const { return ends_; }

    /// Starts all tasks at the next execution. No task may be active.
    void start_all(double now);
    /// Starts a task at the next execution. An error if it is active, or if no task has this name.
    Expected<void> start(std::string_view name, double now);
    /// The active task with this name, to be cancelled; null if it is not active.
    Expected<Task*> find_active(std::string_view name);

    // Call these within a protected call; they may raise Lua errors.

    /// Runs each task that has something to do until it waits or ends, in the order of the declarations.
    void run(lua_State* L, double now);
    /// Ends a task and closes its variables.
    void cancel(lua_State* L, Task& task, double now);
    /// Ends all tasks, as on deactivation. The stack of `L` must be empty.
    void end(lua_State* L, double now);

    /// The status of all tasks in the order of the declarations.
    std::vector<TaskStatus> status(double now) const;

private:
    void begin(lua_State* L, Task& task);
    void run_slice_of(lua_State* L, Task& task, double now);
    static void forget(lua_State* L, Task& task);
    Task* find(std::string_view name);
    Expected<Task*> known(std::string_view name);

    std::deque<Task> tasks_;  // a deque, because addresses must not change
    Task* current_ = nullptr;
    bool closes_ = false;  // while to-be-closed variables are closed
    bool ends_ = false;
};

/// Whether `seconds` have passed from `since` to `now`, except for rounding errors.
inline bool has_passed(double seconds, double since, double now) { return now - since >= seconds - 1e-9; }

}  // namespace nezumi

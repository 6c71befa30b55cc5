// Runs each task in a separate process, several at a time. A crash ends only one task.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi {

/// How a pool ended.
enum class PoolEnd {
    done,
    interrupted,  ///< by SIGINT, SIGTERM or SIGHUP (unless it is ignored): all processes have ended
};

struct PoolTasks {
    std::size_t count = 0;
    /// Called in a separate process, a copy of this one. The result is sent back.
    std::function<std::string(std::size_t task)> run;
    /// Gets the answers in the order of the tasks. An error describes how the process ended instead. After an
    /// interruption it gets the answers of all finished tasks.
    std::function<void(std::size_t task, Expected<std::string> answer)> take;
    /// Called after each task with the number of finished tasks, in any order; may be empty.
    std::function<void(std::size_t done)> progress{};
};

/// Runs at most `jobs` processes at a time. This process must have no other threads. SIGINT, SIGTERM and SIGHUP end all
/// processes.
PoolEnd run_in_processes(const PoolTasks& tasks, std::size_t jobs);

}  // namespace nezumi

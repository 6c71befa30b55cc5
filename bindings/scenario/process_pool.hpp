// Runs tasks in processes of their own, several at a time: a crash ends one task, and nothing is shared.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "engine/base/error.hpp"

namespace nezumi {

/// What a pool came to.
enum class PoolEnd {
    done,
    interrupted,  ///< by SIGINT, SIGTERM or SIGHUP (unless that is ignored): all processes are gone
};

struct PoolTasks {
    std::size_t count = 0;
    /// Runs in a process of its own, a copy of this one; what it returns is sent back.
    std::function<std::string(std::size_t task)> run;
    /// Gets the answers in the order of the tasks; an error says how the process ended instead. After an interruption
    /// it gets those of all tasks that were over.
    std::function<void(std::size_t task, Expected<std::string> answer)> take;
    /// Is told after each task how many are over, in whatever order; may be empty.
    std::function<void(std::size_t done)> progress{};
};

/// At most `jobs` processes at a time. This process must have no other threads. SIGINT, SIGTERM and
/// SIGHUP end all processes.
PoolEnd run_in_processes(const PoolTasks& tasks, std::size_t jobs);

}  // namespace nezumi

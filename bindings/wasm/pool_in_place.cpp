// Runs scenarios without other processes: one after the other, in the calling thread.
#include "bindings/scenario/process_pool.hpp"

namespace nezumi {

PoolEnd run_in_processes(const PoolTasks& tasks, std::size_t /*jobs*/) {
    for (std::size_t task = 0; task < tasks.count; ++task) {
        tasks.take(task, tasks.run(task));
        if (tasks.progress) tasks.progress(task + 1);
    }
    return PoolEnd::done;
}

}  // namespace nezumi

// Runs a job until it is stopped, or abandons it if it hangs.
#include "hw/device/worker.hpp"

#include <chrono>
#include <thread>

#include "hw/device/clock.hpp"

namespace nezumi::hw {

DeviceWorker::DeviceWorker(std::unique_ptr<DeviceJob> job) : state_(std::make_shared<State>()) {
    state_->job = std::move(job);
    // Detached, because a thread that hangs in the kernel can't be joined; so it co-owns the state.
    std::thread([state = state_] { work(*state); }).detach();
}

DeviceWorker::~DeviceWorker() {
    Lock lock(state_->mutex);
    state_->should_end = true;
    state_->bell.ring();
    state_->ended.wait_for(lock, std::chrono::duration<double>(patience), [this] { return state_->has_ended; });
}

void DeviceWorker::work(State& state) {
    const auto should_end = [&] {
        const std::lock_guard lock(state.mutex);
        return state.should_end;
    };
    while (!should_end()) {
        state.job->running_since_ = clock_seconds();
        const double seconds = state.job->run();
        state.job->running_since_ = 0;
        if (!should_end()) state.bell.wait(seconds, state.job->watched_file());
    }
    state.job->end();
    state.job.reset();  // before the waiting thread continues: resources such as a lease are then free
    const std::lock_guard lock(state.mutex);
    state.has_ended = true;
    state.ended.notify_all();
}

}  // namespace nezumi::hw

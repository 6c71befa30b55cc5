// A future is all that both threads share: it may be left alone.
#include "engine/live/act_worker.hpp"

#include <cassert>
#include <utility>

#include "engine/base/thread.hpp"

namespace nezumi {

ActWorker::~ActWorker() {
    if (is_idle()) return;
    if (prepared_.wait_for(std::chrono::seconds(1)) == std::future_status::ready) {
        thread_.join();
    } else {
        thread_.detach();
    }
}

void ActWorker::start(Preparation prepare) {
    assert(is_idle());
    std::packaged_task<PreparedAct()> task(std::move(prepare));
    prepared_ = task.get_future();
    thread_ = start_thread(std::move(task));
}

std::optional<PreparedAct> ActWorker::take(std::chrono::microseconds patience) {
    if (is_idle() || prepared_.wait_for(patience) != std::future_status::ready) return std::nullopt;
    thread_.join();
    return prepared_.get();
}

}  // namespace nezumi

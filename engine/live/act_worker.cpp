// The preparing thread shares only a future with its owner, so either may end first.
#include "engine/live/act_worker.hpp"

#include <cassert>
#include <memory>
#include <system_error>
#include <utility>

#include "engine/base/thread.hpp"

namespace nezumi {

ActWorker::~ActWorker() {
    if (is_idle()) return;
    if (prepared_.wait_for(std::chrono::seconds(1)) == std::future_status::ready) {
        if (thread_.joinable()) thread_.join();
    } else {
        thread_.detach();
    }
}

void ActWorker::start(Preparation prepare) {
    assert(is_idle());
    const auto task = std::make_shared<std::packaged_task<PreparedAct()>>(std::move(prepare));
    prepared_ = task->get_future();
    try {
        thread_ = start_thread([task] { (*task)(); });
    } catch (const std::system_error&) {
        (*task)();
    }
}

std::optional<PreparedAct> ActWorker::take(std::chrono::microseconds patience) {
    if (is_idle() || prepared_.wait_for(patience) != std::future_status::ready) return std::nullopt;
    if (thread_.joinable()) thread_.join();
    return prepared_.get();
}

}  // namespace nezumi

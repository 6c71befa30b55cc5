// Jobs without a thread: `put` runs each job immediately.
#include "bindings/web/job_thread.hpp"

namespace nezumi::web {

JobThread::~JobThread() = default;

bool JobThread::put(std::function<void()> job) {
    job();
    return true;
}

}  // namespace nezumi::web

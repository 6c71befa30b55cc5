// Jobs without a thread: each is done when it is put.
#include "bindings/web/job_thread.hpp"

namespace nezumi::web {

JobThread::~JobThread() = default;

bool JobThread::put(std::function<void()> job) {
    job();
    return true;
}

}  // namespace nezumi::web

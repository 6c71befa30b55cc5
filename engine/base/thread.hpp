// Threads that no signal is delivered to.
#pragma once

#include <pthread.h>

#include <csignal>
#include <thread>
#include <utility>

namespace nezumi {

/// While it lives, threads that are started are left alone by signals: these belong to the thread that ticks.
class WithoutSignals {
public:
    WithoutSignals() {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~WithoutSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    WithoutSignals(const WithoutSignals&) = delete;
    WithoutSignals& operator=(const WithoutSignals&) = delete;

private:
    sigset_t before_{};
};

/// @throws std::system_error  where the system gives no further thread
template <class Run>
std::thread start_thread(Run run) {
    const WithoutSignals without_signals;
    return std::thread(std::move(run));
}

}  // namespace nezumi

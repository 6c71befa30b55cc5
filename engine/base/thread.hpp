// Threads that receive no signals.
#pragma once

#include <pthread.h>

#include <csignal>
#include <thread>
#include <utility>

namespace nezumi {

/// Threads that are started while an object of this class exists receive no signals; the ticking thread gets them.
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

/// @throws std::system_error  if the system provides no further thread
template <class Run>
std::thread start_thread(Run run) {
    const WithoutSignals without_signals;
    return std::thread(std::move(run));
}

}  // namespace nezumi

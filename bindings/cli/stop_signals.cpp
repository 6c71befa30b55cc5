// A handler can reach nothing but a variable of the whole program.
#include "bindings/cli/stop_signals.hpp"

#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "engine/base/thread.hpp"

namespace nezumi::cli {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): the only thing that a signal's handler can reach
volatile std::sig_atomic_t last_signal = 0;

// Whoever asks again is in a hurry: posted then, and at the end of it all.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): likewise
sem_t hurried;
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): likewise
volatile std::sig_atomic_t second_signal = 0, second_is_awaited = 0;

void take(int signal) {
    const int saved_errno = errno;
    const bool second = last_signal != 0;
    if (!second) last_signal = signal;
    if (second) second_signal = signal;
    if (second || second_is_awaited == 0) {
        for (const int each : StopSignals::signals) std::signal(each, SIG_DFL);
    }
    if (second) sem_post(&hurried);
    errno = saved_errno;
}

void end_by(int signal) {
    kill(getpid(), signal);
    _exit(128 + signal);  // the first process of a container is not ended by signals
}

}  // namespace

StopSignals::StopSignals() {
    last_signal = 0;
    second_signal = 0;
    second_is_awaited = 0;
    sem_init(&hurried, 0, 0);
    struct sigaction action {};
    action.sa_handler = take;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], nullptr, &before_[i]);
        if (before_[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, &pipe_before_);
}

void StopSignals::at_second(std::function<void()> action) {
    // Signals are for the thread that runs the loop: they end its waiting.
    hurry_ = start_thread([action = std::move(action)] {
        while (sem_wait(&hurried) != 0) {
        }
        if (second_signal == 0) return;
        action();
        end_by(second_signal);
    });
    second_is_awaited = 1;
}

StopSignals::~StopSignals() {
    if (hurry_.joinable()) {
        sem_post(&hurried);
        hurry_.join();
    }
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
    sigaction(SIGPIPE, &pipe_before_, nullptr);
}

const volatile std::sig_atomic_t& StopSignals::received() const { return last_signal; }

}  // namespace nezumi::cli

// A handler can reach nothing but a variable of the whole program.
#include "bindings/cli/stop_signals.hpp"

namespace nezumi::cli {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): the only thing that a signal's handler can reach
volatile std::sig_atomic_t last_signal = 0;

void take(int signal) {
    last_signal = signal;
    // Whoever asks again is in a hurry.
    for (const int each : StopSignals::signals) std::signal(each, SIG_DFL);
}

}  // namespace

StopSignals::StopSignals() {
    last_signal = 0;
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

StopSignals::~StopSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
    sigaction(SIGPIPE, &pipe_before_, nullptr);
}

const volatile std::sig_atomic_t& StopSignals::received() const { return last_signal; }

}  // namespace nezumi::cli

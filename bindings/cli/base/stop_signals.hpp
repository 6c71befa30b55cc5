// Signals such as Ctrl-C: the first one ends a run normally within 2 s. The second one ends it immediately, but its
// files are completed first.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

namespace nezumi::cli {

/// While an instance exists, the first SIGINT, SIGTERM or SIGHUP is only recorded, and writing to a pipe without a
/// reader is an ordinary error. A signal that was ignored before (nohup, background jobs of a shell) stays ignored.
/// Only one instance at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The first signal that was received, or 0.
    const volatile std::sig_atomic_t& received() const;

    /// What a run is waiting for instead of ending, and the exit status if it is ended by force.
    struct Held {
        std::string by;
        int status = 0;
    };
    /// Actions for a run that does not end; called on other threads at any time.
    struct Ends {
        /// `until_given_up` after the first signal: drops what is not written yet, so that the run can end.
        std::function<void()> give_up;
        /// Completes the files with the data so far, within one second. Called after the second signal, or
        /// `until_ended` after the first one; then the program is ended by force.
        std::function<void()> at_once;
        std::function<Held()> held;
    };
    /// From now on the actions of `ends` are called when they are due. A third signal ends the program without any
    /// action. Call this function once.
    void watch_end(Ends ends);

    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
    static constexpr std::chrono::milliseconds until_given_up{1500}, until_ended{2000};

private:
    std::array<struct sigaction, signals.size()> before_{};
    struct sigaction pipe_before_ {};
    std::thread watch_;
};

}  // namespace nezumi::cli

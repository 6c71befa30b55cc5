// Signals such as Ctrl-C: the first one ends a run in order, within 2 s; the second one immediately, but with complete
// files.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

namespace nezumi::cli {

/// During its lifetime, SIGINT, SIGTERM and SIGHUP are only recorded the first time, and writing to a pipe without a
/// reader is an ordinary error. A signal that was ignored before (nohup, background jobs of a shell) stays ignored.
/// Only one instance at a time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The signal received, or 0.
    const volatile std::sig_atomic_t& received() const;

    /// What keeps a run from ending, and its exit status.
    struct Held {
        std::string by;
        int status = 0;
    };
    /// Actions for a run that does not end; called on other threads at any time.
    struct Ends {
        /// `until_given_up` after the first signal: drops what is not written yet, so that the run can end.
        std::function<void()> give_up;
        /// At the second signal, which then ends the program, or `until_ended` after the first: completes the files
        /// with the present data. It has one second.
        std::function<void()> at_once;
        std::function<Held()> held;
    };
    /// Starts watching. A third signal ends the program without any action. Call it once.
    void watch_end(Ends ends);

    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
    static constexpr std::chrono::milliseconds until_given_up{1500}, until_ended{2000};

private:
    std::array<struct sigaction, signals.size()> before_{};
    struct sigaction pipe_before_ {};
    std::thread watch_;
};

}  // namespace nezumi::cli

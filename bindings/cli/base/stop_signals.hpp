// Ctrl-C and its kin: the first ends a run in good order, but within 2 s; the second at once and with its files whole.
#pragma once

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <thread>

namespace nezumi::cli {

/// While one exists, SIGINT, SIGTERM and SIGHUP are only noted, the first time; and writing to a pipe that nobody reads
/// is an error like others. A signal that was ignored before (nohup, a shell's background jobs) stays ignored. One at a
/// time.
class StopSignals {
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The signal that has come, 0 before.
    const volatile std::sig_atomic_t& received() const;

    /// What a run waits for that does not end, and the status that it ends with.
    struct Held {
        std::string by;
        int status = 0;
    };
    /// What is done for an end that does not come, on other threads, wherever the run's own are in the middle of.
    struct Ends {
        /// `until_given_up` after the first signal: what is not written yet is given up, so that the end may come.
        std::function<void()> give_up;
        /// At the second signal, which then ends the program, or `until_ended` after the first: files are completed
        /// with what they have. It is given a second.
        std::function<void()> at_once;
        std::function<Held()> held;
    };
    /// From now on. A third signal ends the program without anything. Once.
    void watch_end(Ends ends);

    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
    static constexpr std::chrono::milliseconds until_given_up{1500}, until_ended{2000};

private:
    std::array<struct sigaction, signals.size()> before_{};
    struct sigaction pipe_before_ {};
    std::thread watch_;
};

}  // namespace nezumi::cli

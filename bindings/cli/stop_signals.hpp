// Ctrl-C and its kin: the first ends a run in good order, the second at once and with its files whole.
#pragma once

#include <array>
#include <csignal>
#include <functional>
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

    /// From now on the second signal runs this on a thread of its own, wherever the others are in the middle of, before
    /// it ends the program; a third one ends it at once. Once.
    void at_second(std::function<void()> action);

    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

private:
    std::array<struct sigaction, signals.size()> before_{};
    struct sigaction pipe_before_ {};
    std::thread hurry_;
};

}  // namespace nezumi::cli

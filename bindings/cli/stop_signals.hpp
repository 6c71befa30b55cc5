// Ctrl-C and its kin: the first ends a run in good order, the second at once.
#pragma once

#include <array>
#include <csignal>

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

    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

private:
    std::array<struct sigaction, signals.size()> before_{};
    struct sigaction pipe_before_ {};
};

}  // namespace nezumi::cli

// `--realtime`: kernel settings for a run with a clock, so that other programs don't delay its ticks.
#pragma once

#include <functional>
#include <string>

namespace nezumi::cli {

/// The requests to the kernel; each returns 0 or an errno. Tests replace them.
struct Kernel {
    std::function<int(int priority)>
        schedule;                      ///< the calling thread gets priority over all ordinary ones; 0: an ordinary one
    std::function<int()> lock_memory;  ///< of the whole program, present and future
};
Kernel the_kernel();

/// During its lifetime the thread that made it has priority over ordinary ones, and memory is locked. Threads and
/// processes started by this thread are ordinary, as are all earlier ones.
class RealTime {
public:
    /// Below the kernel's interrupt threads, which have 50 if they exist.
    static constexpr int priority = 40;

    explicit RealTime(Kernel kernel = the_kernel());
    ~RealTime();
    RealTime(const RealTime&) = delete;
    RealTime& operator=(const RealTime&) = delete;

    /// One line: what was granted, and what to do about the rest.
    const std::string& told() const { return told_; }

private:
    Kernel kernel_;
    bool scheduled_ = false;
    std::string told_;
};

}  // namespace nezumi::cli

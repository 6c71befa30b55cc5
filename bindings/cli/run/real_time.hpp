// `--realtime`: kernel settings for a run with a clock, so that other programs don't delay its ticks.
#pragma once

#include <functional>
#include <string>

namespace nezumi::cli {

/// The requests to the kernel; each returns 0 or an errno. Tests replace them.
struct Kernel {
    std::function<int(int priority)>
        schedule;  ///< makes the calling thread a real-time thread with this priority; 0: an ordinary thread
    std::function<int()> lock_memory;  ///< locks the present and future memory of the program
};
Kernel the_kernel();

/// While this object exists, the thread that created it has priority over ordinary threads, and memory is locked. All
/// other threads stay ordinary, also threads and processes that this thread starts.
class RealTime {
public:
    /// Lower than the priority of the kernel's interrupt threads, which is 50 if they exist.
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

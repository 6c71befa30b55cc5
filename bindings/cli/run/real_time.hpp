// `--realtime`: what a run that follows the clock asks of the kernel, so that other programs don't make its ticks late.
#pragma once

#include <functional>
#include <string>

namespace nezumi::cli {

/// What is asked of the kernel: each returns 0, or an errno. Tests answer in its place.
struct Kernel {
    std::function<int(int priority)> schedule;  ///< the calling thread before all ordinary ones; 0: as an ordinary one
    std::function<int()> lock_memory;           ///< of the whole program, now and from now on
};
Kernel the_kernel();

/// The thread that makes it runs before all ordinary ones while this lives, and memory stays where it is. Threads and
/// processes that this thread starts are ordinary ones, as are all that there were before.
class RealTime {
public:
    /// Below the kernel's own threads for interrupts, which have 50 where it has such.
    static constexpr int priority = 40;

    explicit RealTime(Kernel kernel = the_kernel());
    ~RealTime();
    RealTime(const RealTime&) = delete;
    RealTime& operator=(const RealTime&) = delete;

    /// One line: what it has got, and what to do about what it has not.
    const std::string& told() const { return told_; }

private:
    Kernel kernel_;
    bool scheduled_ = false;
    std::string told_;
};

}  // namespace nezumi::cli

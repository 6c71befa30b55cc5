// Sends a signal to a thread after every few milliseconds of its own CPU time.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <memory>

namespace nezumi {

/// Belongs to the thread that makes it. Does not wake an idle thread.
class ThreadTimer {
public:
    /// Time between two signals [ns].
    static constexpr std::int64_t period = 5'000'000;
    using Handler = void (*)(int signal, siginfo_t* info, void* context);

    ThreadTimer() = default;
    ~ThreadTimer() { stop(); }
    ThreadTimer(const ThreadTimer&) = delete;
    ThreadTimer& operator=(const ThreadTimer&) = delete;

    /// Starts the timer (again, in the child of a fork). `handler` is the same for all threads. If the kernel has no
    /// timer left (RLIMIT_SIGPENDING), another thread watches the clock of this one. False if this is impossible as
    /// well.
    bool restart(Handler handler);
    void stop();

    /// Call this after a handler was left by a jump, because its signals are still blocked.
    static void unblock();

private:
    struct Watched;
    bool start_kernel_timer();
    bool start_watcher(Handler handler);

    pid_t process_ = 0;  // the process in which it started; 0: it does not run
    timer_t timer_{};
    std::shared_ptr<Watched> watched_;  // watched by a thread; null: by the kernel
};

}  // namespace nezumi

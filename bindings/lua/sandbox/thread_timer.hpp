// A signal to a thread after every few milliseconds of its own CPU time.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <memory>

namespace nezumi {

/// Belongs to the thread that makes it. A thread that is idle is not woken.
class ThreadTimer {
public:
    /// Between two signals [ns].
    static constexpr std::int64_t period = 5'000'000;
    using Handler = void (*)(int signal, siginfo_t* info, void* context);

    ThreadTimer() = default;
    ~ThreadTimer() { stop(); }
    ThreadTimer(const ThreadTimer&) = delete;
    ThreadTimer& operator=(const ThreadTimer&) = delete;

    /// Begins (again, in the child of a fork). `handler` is the same for all threads. Where the kernel gives no timer,
    /// as when all signals that may wait are taken (RLIMIT_SIGPENDING), another thread looks at the clock of this one.
    /// False where that can't be had either.
    bool restart(Handler handler);
    void stop();

    /// A handler that is left by a jump has the thread's signals blocked.
    static void unblock();

private:
    struct Watched;
    bool start_kernel_timer();
    bool start_watcher(Handler handler);

    pid_t process_ = 0;  // in which it began; 0: it does not run
    timer_t timer_{};
    std::shared_ptr<Watched> watched_;  // by a thread; null: by the kernel
};

}  // namespace nezumi

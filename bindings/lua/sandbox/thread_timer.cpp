// Timers of the kernel, and a thread that replaces them.
#include "bindings/lua/sandbox/thread_timer.hpp"

#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <system_error>
#include <utility>

#include "engine/base/mutex.hpp"
#include "engine/base/sanitizers.hpp"
#include "engine/base/thread.hpp"

#if defined(NEZUMI_THREAD_SANITIZER)
// ThreadSanitizer delays signals until the thread calls into libc, which an endless loop never does. `__sigaction` is
// the same function as `sigaction`, but ThreadSanitizer does not intercept it.
extern "C" int __sigaction(int, const struct sigaction*, struct sigaction*);
#define NEZUMI_SIGACTION __sigaction
#else
#define NEZUMI_SIGACTION sigaction
#endif

namespace nezumi {
namespace {

int timer_signal() { return SIGRTMIN + 5; }
// A signal that needs no place in the queue of waiting signals, which may be full, and that processes ignore by
// default.
constexpr int watcher_signal = SIGURG;

sigset_t both_signals() {
    sigset_t both;
    sigemptyset(&both);
    sigaddset(&both, timer_signal());
    sigaddset(&both, watcher_signal);
    return both;
}

void mask_signals(int how) {
    const sigset_t both = both_signals();
    pthread_sigmask(how, &both, nullptr);
}

bool install(int signal, ThreadTimer::Handler handler) {
    struct sigaction action {};
    action.sa_sigaction = handler;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    action.sa_mask = both_signals();
    return NEZUMI_SIGACTION(signal, &action, nullptr) == 0;
}

}  // namespace

struct ThreadTimer::Watched {
    Mutex mutex;
    bool has_ended = false;
    pthread_t thread = pthread_self();
    clockid_t clock{};

    static void watch(const std::shared_ptr<Watched>& watched) {
        std::int64_t signalled = 0;  // [ns] of the thread's CPU time
        for (;; std::this_thread::sleep_for(std::chrono::nanoseconds(period))) {
            const Lock lock(watched->mutex);
            timespec time{};
            if (watched->has_ended || clock_gettime(watched->clock, &time) != 0) return;
            const std::int64_t now = static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
            if (now - signalled < period) continue;
            signalled = now;
            pthread_kill(watched->thread, watcher_signal);
        }
    }
};

bool ThreadTimer::start_kernel_timer() {
    sigevent event{};
    event.sigev_notify = SIGEV_THREAD_ID;
    event.sigev_signo = timer_signal();
    event._sigev_un._tid = static_cast<pid_t>(syscall(SYS_gettid));
    if (timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &timer_) != 0) return false;
    itimerspec times{};
    times.it_interval.tv_nsec = times.it_value.tv_nsec = period;
    if (timer_settime(timer_, 0, &times, nullptr) == 0) return true;
    timer_delete(timer_);
    return false;
}

bool ThreadTimer::start_watcher(Handler handler) {
    static const bool installed = install(watcher_signal, handler);
    auto watched = std::make_shared<Watched>();
    if (!installed || pthread_getcpuclockid(watched->thread, &watched->clock) != 0) return false;
    try {
        start_thread([watched] { Watched::watch(watched); }).detach();
    } catch (const std::system_error&) {
        return false;
    }
    watched_ = std::move(watched);
    return true;
}

bool ThreadTimer::restart(Handler handler) {
    stop();
    static const bool installed = install(timer_signal(), handler);
    if (!installed || (!start_kernel_timer() && !start_watcher(handler))) return false;
    process_ = getpid();
    unblock();
    return true;
}

void ThreadTimer::stop() {
    if (process_ == getpid()) {
        mask_signals(SIG_BLOCK);  // a signal that is on its way must not use destroyed variables of the thread
        if (watched_ != nullptr) {
            const Lock lock(watched_->mutex);
            watched_->has_ended = true;
        } else {
            timer_delete(timer_);
        }
    }
    // The child of a fork has neither the timer nor the watching thread.
    watched_ = nullptr;
    process_ = 0;
}

void ThreadTimer::unblock() { mask_signals(SIG_UNBLOCK); }

}  // namespace nezumi

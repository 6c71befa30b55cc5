// A signal handler can access only global variables: it wakes a thread that does the work.
#include "bindings/cli/base/stop_signals.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <ctime>
#include <memory>
#include <system_error>
#include <utility>

#include "engine/base/thread.hpp"

namespace nezumi::cli {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler can access nothing else
volatile std::sig_atomic_t last_signal = 0;

// Posted by each signal, and at the end of the run.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): likewise
sem_t news;
// A handler may use lock-free atomics. The watching thread reads them too.
static_assert(std::atomic<int>::is_always_lock_free);
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): likewise
std::atomic<int> second_signal = 0, is_watched = 0, is_over = 0;

// Time limits for completing files after a second signal, and for writing a line.
constexpr std::chrono::milliseconds longest_completion{1000}, longest_telling{100};

void take(int signal) {
    const int saved_errno = errno;
    const bool second = last_signal != 0;
    if (second)
        second_signal = signal;
    else
        last_signal = signal;
    if (second || is_watched == 0) {
        for (const int each : StopSignals::signals) std::signal(each, SIG_DFL);
    }
    sem_post(&news);
    errno = saved_errno;
}

// True if the semaphore was posted before `until`.
bool is_posted_before(sem_t& semaphore, std::chrono::steady_clock::time_point until) {
    const auto since_begin = until.time_since_epoch();  // of the monotonic clock
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_begin);
    const timespec end{.tv_sec = static_cast<std::time_t>(seconds.count()),
                       .tv_nsec = static_cast<long>(std::chrono::nanoseconds(since_begin - seconds).count())};
    while (sem_clockwait(&semaphore, CLOCK_MONOTONIC, &end) != 0) {
        if (errno != EINTR) return false;
    }
    return true;
}

// Runs `action` on another thread and waits for at most `patience`: the action may hang in a file system.
void do_within(std::chrono::milliseconds patience, std::function<void()> action) {
    struct Shared {
        Shared() { sem_init(&done, 0, 0); }
        sem_t done{};
    };
    const auto shared = std::make_shared<Shared>();
    try {
        start_thread([shared, action = std::move(action)] {
            action();
            sem_post(&shared->done);
        }).detach();
    } catch (const std::system_error&) {
        return;
    }
    is_posted_before(shared->done, std::chrono::steady_clock::now() + patience);
}

// Writes the line only if standard error can take data now: otherwise writing would block.
void tell_if_taken(const std::string& line) {
    pollfd error{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    if (poll(&error, 1, 0) > 0) static_cast<void>(write(STDERR_FILENO, line.data(), line.size()) >= 0);
}

[[noreturn]] void end_by(int signal) {
    kill(getpid(), signal);
    _exit(128 + signal);  // kill() does not end the first process of a container
}

void watch_end_of_run(const StopSignals::Ends& ends) {
    // Waits for a signal or the end of the run. A second signal ends the program. Returns true if the run has ended.
    const auto is_over_before = [&](std::chrono::steady_clock::time_point until) {
        is_posted_before(news, until);
        if (second_signal != 0) {
            do_within(longest_completion, ends.at_once);
            end_by(second_signal);
        }
        return is_over != 0;
    };
    while (sem_wait(&news) != 0) {
    }
    if (is_over != 0) return;
    const auto came = std::chrono::steady_clock::now();
    if (is_over_before(came + StopSignals::until_given_up)) return;
    ends.give_up();
    if (is_over_before(came + StopSignals::until_ended)) return;
    const StopSignals::Held held = ends.held();
    const std::string line = fmt::format(
        "nezumi: {:g} s after SIG{} the run was still waiting for {}, so it was ended by force\n",
        std::chrono::duration<double>(StopSignals::until_ended).count(), sigabbrev_np(last_signal), held.by);
    do_within(longest_telling, [line] { tell_if_taken(line); });
    do_within(longest_completion, ends.at_once);
    _exit(held.status);
}

}  // namespace

StopSignals::StopSignals() {
    last_signal = 0;
    second_signal = 0;
    is_watched = 0;
    is_over = 0;
    sem_init(&news, 0, 0);
    struct sigaction action {};
    action.sa_handler = take;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], nullptr, &before_[i]);
        if (before_[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, &pipe_before_);
}

void StopSignals::watch_end(Ends ends) {
    // `start_thread` blocks signals in the new thread: they must go to the thread that runs the loop, to end its
    // waiting.
    watch_ = start_thread([ends = std::move(ends)] { watch_end_of_run(ends); });
    is_watched = 1;
}

StopSignals::~StopSignals() {
    if (watch_.joinable()) {
        is_over = 1;
        sem_post(&news);
        watch_.join();
    }
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
    sigaction(SIGPIPE, &pipe_before_, nullptr);
}

const volatile std::sig_atomic_t& StopSignals::received() const { return last_signal; }

}  // namespace nezumi::cli

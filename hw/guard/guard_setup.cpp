// Makes a forked process independent of its engine.
#include "hw/guard/guard_setup.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace nezumi::hw {
namespace {

// The kernel's signal that the engine's main thread is dead. The end of the socket comes later, because it waits for
// all threads, and a thread in a device ends only after its reading.
constexpr int engine_died = SIGUSR1;

// Commands that kill every nezumi (`pkill nezumi`, `pkill -f nezumi`, `killall nezumi`) must not kill the guard.
constexpr std::string_view guard_name = "motor-guard";

void close_all_but(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    if (low > 3) close_range(3, static_cast<unsigned>(low) - 1, 0);
    if (high > low + 1) close_range(static_cast<unsigned>(low) + 1, static_cast<unsigned>(high) - 1, 0);
    close_range(static_cast<unsigned>(high) + 1, UINT_MAX, 0);
    const int nothing = open("/dev/null", O_RDWR);
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, file);
    if (nothing > STDERR_FILENO) close(nothing);
}

// Gives this process a separate session, process group, name and command line.
void part_from_engine(const ProcessWords& words) {
    setsid();
    prctl(PR_SET_NAME, guard_name.data());
    if (words.begin == nullptr || words.size <= guard_name.size()) return;
    std::memset(words.begin, 0, words.size);
    std::memcpy(words.begin, guard_name.data(), guard_name.size());
}

// Ctrl-C in the engine's terminal must not end the guard, because the engine may take a while to end. Other signals
// have their usual effect.
void set_signals() {
    for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
    for (const int signal : {SIGINT, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) std::signal(signal, SIG_IGN);
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, engine_died);
    sigprocmask(SIG_SETMASK, &only, nullptr);
}

int open_death_notice() {
    sigset_t only;
    sigemptyset(&only);
    sigaddset(&only, engine_died);
    return signalfd(-1, &only, SFD_CLOEXEC | SFD_NONBLOCK);
}

// If permitted: real-time priority, so that load does not delay stopping the motors, and the lowest rank when the
// kernel kills processes for lack of memory, even a whole cgroup (memory.oom.group).
void claim_resources() {
    const sched_param priority{.sched_priority = 1};
    sched_setscheduler(0, SCHED_FIFO, &priority);
    if (const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC); file >= 0) {
        [[maybe_unused]] const ssize_t written = write(file, "-1000", 5);
        close(file);
    }
}

}  // namespace

ProcessWords ProcessWords::of_this() {
    // proc(5): arg_start and arg_end are fields 48 and 49. The program's name, field 2, may contain any characters.
    std::array<char, 1024> text{};
    const int file = open("/proc/self/stat", O_RDONLY | O_CLOEXEC);
    const ssize_t length = file < 0 ? -1 : read(file, text.data(), text.size() - 1);
    if (file >= 0) close(file);
    const char* at = length > 0 ? std::strrchr(text.data(), ')') : nullptr;
    for (int field = 2; at != nullptr && field < 48; ++field) at = std::strchr(at + 1, ' ');
    if (at == nullptr) return {};
    char* next = nullptr;
    const std::uintptr_t begin = std::strtoull(at, &next, 10), end = std::strtoull(next, nullptr, 10);
    if (begin == 0 || end <= begin) return {};
    return {reinterpret_cast<char*>(begin), end - begin};  // NOLINT(performance-no-int-to-ptr): the kernel's own word
}

int become_guard(int socket, int lease, const ProcessWords& words) {
    part_from_engine(words);
    set_signals();
    prctl(PR_SET_PDEATHSIG, engine_died);
    close_all_but(socket, lease);
    const int death = open_death_notice();
    claim_resources();
    return death;
}

}  // namespace nezumi::hw

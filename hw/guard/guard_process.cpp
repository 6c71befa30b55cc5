// Waits for beats, for the end of the socket, and for the death of the engine's thread that forked it.
#include "hw/guard/guard_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "hw/device/clock.hpp"
#include "hw/guard/guarded_node.hpp"

namespace nezumi::hw {
namespace {

// The kernel's signal that the engine's main thread is dead. The end of the socket comes later, because it waits for
// all threads, and a thread in a device ends only after its reading.
constexpr int engine_died = SIGUSR1;

// Commands that kill every nezumi (`pkill nezumi`, `pkill -f nezumi`, `killall nezumi`) must not kill the guard.
constexpr std::string_view guard_name = "motor-guard";

using Nodes = std::array<GuardedNode, GuardOrder::most_nodes>;

// Each node in its own process, so that one that hangs does not delay the others. Returns when all are written, or
// after `patience` [s].
void stop_all(const Nodes& nodes, int socket) {
    constexpr double patience = 0.1;
    const double begin = clock_seconds();
    std::size_t writing = 0;
    for (const GuardedNode& each : nodes) {
        if (each.file < 0) continue;
        const pid_t process = fork();
        if (process > 0) ++writing;
        if (process > 0) continue;
        if (process == 0) close(socket);  // the guard must see the socket's end
        stop(each);
        if (process == 0) _exit(0);
    }
    while (writing > 0 && clock_seconds() - begin < patience) {
        const pid_t ended = waitpid(-1, nullptr, WNOHANG);
        if (ended < 0) break;
        ended > 0 ? static_cast<void>(--writing) : static_cast<void>(usleep(200));
    }
}

void close_all_but(int a, int b) {
    const auto [low, high] = std::minmax(a, b);
    if (low > 3) close_range(3, static_cast<unsigned>(low) - 1, 0);
    if (high > low + 1) close_range(static_cast<unsigned>(low) + 1, static_cast<unsigned>(high) - 1, 0);
    close_range(static_cast<unsigned>(high) + 1, UINT_MAX, 0);
    const int nothing = open("/dev/null", O_RDWR);
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, file);
    if (nothing > STDERR_FILENO) close(nothing);
}

// Gets its own session, process group, name and command line.
void part_from_engine(const ProcessWords& words) {
    setsid();
    prctl(PR_SET_NAME, guard_name.data());
    if (words.begin == nullptr || words.size <= guard_name.size()) return;
    std::memset(words.begin, 0, words.size);
    std::memcpy(words.begin, guard_name.data(), guard_name.size());
}

// Ctrl-C in the engine's terminal must not end the guard, since the engine may take a while to end. Other signals are
// as usual.
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

void say(int socket, const GuardAnswer& answer) { send(socket, &answer, sizeof answer, MSG_DONTWAIT | MSG_NOSIGNAL); }

GuardAnswer prove(const Nodes& nodes, double tm) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (const int error = problem_of(nodes[i]); error != 0)
            return {
                .kind = GuardAnswer::Kind::unproved, .tm = tm, .index = static_cast<std::uint8_t>(i), .error = error};
    }
    return {.kind = GuardAnswer::Kind::proved, .tm = tm};
}

// Receives one order. Returns the result of recvmsg(2): 0 at the socket's end, negative if there is none.
ssize_t receive(int socket, GuardOrder& order, int& file) {
    iovec content{.iov_base = &order, .iov_len = sizeof order};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> extra{};
    msghdr message{};
    message.msg_iov = &content;
    message.msg_iovlen = 1;
    message.msg_control = extra.data();
    message.msg_controllen = extra.size();
    const ssize_t length = recvmsg(socket, &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
    file = -1;
    if (const cmsghdr* header = CMSG_FIRSTHDR(&message); length > 0 && header != nullptr)
        std::memcpy(&file, CMSG_DATA(header), sizeof file);
    return length;
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

void be_guard(int socket, int lease, pid_t engine, const ProcessWords& words) {
    part_from_engine(words);
    set_signals();
    prctl(PR_SET_PDEATHSIG, engine_died);
    close_all_but(socket, lease);
    const int death = open_death_notice();
    claim_resources();

    Nodes nodes;
    bool awaits_beat = false;
    bool brakes = false;
    double beat_at = 0;
    while (getppid() == engine) {
        std::array<pollfd, 2> files{pollfd{.fd = socket, .events = POLLIN, .revents = 0},
                                    pollfd{.fd = death, .events = POLLIN, .revents = 0}};
        const double left = beat_at + beat_timeout - clock_seconds();
        const int timeout = awaits_beat ? std::max(0, static_cast<int>(left * 1e3) + 1) : -1;
        if (poll(files.data(), files.size(), timeout) < 0 && errno != EINTR) break;
        if (files[1].revents != 0) break;
        if (files[0].revents == 0) {
            if (!awaits_beat || clock_seconds() - beat_at < beat_timeout) continue;
            stop_all(nodes, socket);
            awaits_beat = false;
            say(socket, {.kind = GuardAnswer::Kind::stopped});
            continue;
        }
        GuardOrder order;
        int file = -1;
        const ssize_t length = receive(socket, order, file);
        if (length == 0 || (length < 0 && errno != EAGAIN && errno != EINTR)) break;
        if (length < 0) continue;
        switch (order.kind) {
            case GuardOrder::Kind::node: take_up(nodes.at(order.node.index), order.node, file); break;
            case GuardOrder::Kind::rest: awaits_beat = false; break;
            case GuardOrder::Kind::brake: brakes = true; break;
            case GuardOrder::Kind::beat:
                if (brakes) break;
                awaits_beat = true;
                beat_at = order.tm;  // not the time of receiving: both processes may have been suspended meanwhile
                say(socket, prove(nodes, order.tm));
                break;
        }
        // Undoes writes that came after.
        if (brakes) {
            stop_all(nodes, socket);
            say(socket, {.kind = GuardAnswer::Kind::stopped});
        }
    }
    stop_all(nodes, socket);
    _exit(0);
}

}  // namespace nezumi::hw

// Waits for beats, for the end of the socket, and for the death of the engine's thread that forked it.
#include "hw/guard/guard_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

// The kernel's word that the engine's main thread is dead. The socket's end comes later: it waits for all threads, and
// a thread that waits for a device ends only with its reading.
constexpr int engine_died = SIGUSR1;

void write_stop(const StopWrite& stop) {
    const int file = open(stop.path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file < 0) return;
    struct stat status {};
    if (fstat(file, &status) == 0 && S_ISREG(status.st_mode) && ftruncate(file, 0) != 0) status = {};
    [[maybe_unused]] const ssize_t written = write(file, stop.text.data(), stop.text.size());
    close(file);
}

// Each in a process of its own: a node that does not answer keeps none of the others from being written. Returns when
// all are, or `patience` [s] later.
void write_stops(std::span<const StopWrite> stops, int socket) {
    constexpr double patience = 0.1;
    const double begin = clock_seconds();
    std::size_t writing = 0;
    for (const StopWrite& each : stops) {
        const pid_t process = fork();
        if (process > 0) ++writing;
        if (process > 0) continue;
        if (process == 0) close(socket);  // its end is the guard's
        write_stop(each);
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

// Ctrl-C in the engine's terminal is not for the guard, whose engine may take a while to end; all else is as anywhere.
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

void say(int socket, GuardMessage message) { send(socket, &message, 1, MSG_DONTWAIT | MSG_NOSIGNAL); }

}  // namespace

void be_guard(int socket, int lease, pid_t engine, std::span<const StopWrite> stop_writes) {
    setsid();
    set_signals();
    prctl(PR_SET_NAME, "nezumi-guard");
    prctl(PR_SET_PDEATHSIG, engine_died);
    close_all_but(socket, lease);
    const int death = open_death_notice();
    // Where it may: before all that is not of real time, or the machine's load would be the motors' time.
    const sched_param priority{.sched_priority = 1};
    sched_setscheduler(0, SCHED_FIFO, &priority);

    bool awaits_beat = false;
    double beat_at = 0;
    while (getppid() == engine) {
        std::array<pollfd, 2> files{pollfd{.fd = socket, .events = POLLIN, .revents = 0},
                                    pollfd{.fd = death, .events = POLLIN, .revents = 0}};
        const double left = beat_at + beat_timeout - clock_seconds();
        const int timeout = awaits_beat ? std::max(0, static_cast<int>(left * 1e3) + 1) : -1;
        if (poll(files.data(), files.size(), timeout) < 0 && errno != EINTR) break;
        if (files[1].revents != 0) break;
        if (files[0].revents != 0) {
            std::array<GuardMessage, 64> messages{};
            const ssize_t count = recv(socket, messages.data(), messages.size(), MSG_DONTWAIT);
            if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) break;
            const auto* const end = messages.data() + std::max<ssize_t>(count, 0);
            if (std::find<const GuardMessage*>(messages.data(), end, GuardMessage::brake) != end) {
                write_stops(stop_writes, socket);
                awaits_beat = false;
                say(socket, GuardMessage::stopped);
            } else if (count > 0) {
                awaits_beat = messages[static_cast<std::size_t>(count) - 1] == GuardMessage::beat;
                beat_at = clock_seconds();
                say(socket, GuardMessage::beat);
            }
        } else if (awaits_beat && clock_seconds() - beat_at >= beat_timeout) {
            write_stops(stop_writes, socket);
            awaits_beat = false;
            say(socket, GuardMessage::stopped);
        }
    }
    write_stops(stop_writes, socket);
    _exit(0);
}

}  // namespace nezumi::hw

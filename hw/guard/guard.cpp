// Forks the guard and talks to it without ever waiting.
#include "hw/guard/guard.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/base/mutex.hpp"

namespace nezumi::hw {
namespace {

// Who ends the program at once knows no robots.
struct AllGuards {
    Mutex mutex;
    std::vector<Guard*> guards;
};
AllGuards& all_guards() {
    static AllGuards the;
    return the;
}

}  // namespace

Guard::Guard(Lease lease, int socket, pid_t process) : lease_(std::move(lease)), socket_(socket), process_(process) {
    const std::lock_guard lock(all_guards().mutex);
    all_guards().guards.push_back(this);
}

void Guard::brake_all() {
    const auto end = std::chrono::steady_clock::now() + longest_braking;
    const std::lock_guard lock(all_guards().mutex);
    std::vector<std::pair<const Guard*, int>> braking;
    for (Guard* guard : all_guards().guards) {
        braking.emplace_back(guard, guard->stops_);
        guard->say(GuardMessage::brake);
    }
    const auto has_stopped = [](const auto& each) {
        return each.first->has_ended_ || each.first->stops_ != each.second;
    };
    while (!std::all_of(braking.begin(), braking.end(), has_stopped) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

Expected<std::unique_ptr<Guard>> Guard::start(const DevicePath& lease, std::vector<StopWrite> stop_writes) {
    const bool is_real = lease.files().are_real();
    if (!is_real) stop_writes.clear();
    auto taken = is_real ? Lease::take(lease.text()) : Lease::of_nothing();
    if (!taken) return Unexpected(taken.error());
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return failure(std::string("no guard process for the motors: ") + std::strerror(errno));
    const pid_t engine = getpid();
    const pid_t process = fork();
    if (process == 0) be_guard(ends[1], taken->file(), engine, stop_writes);
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return failure(std::string("no guard process for the motors: ") + std::strerror(errno));
    }
    return std::unique_ptr<Guard>(new Guard(std::move(*taken), ends[0], process));
}

Guard::~Guard() {
    {
        const std::lock_guard lock(all_guards().mutex);
        std::erase(all_guards().guards, this);
    }
    close(socket_);
    kill(process_, SIGCONT);  // it may have been stopped
    // One that hangs in the kernel is left behind.
    if (const int guard = static_cast<int>(syscall(SYS_pidfd_open, process_, 0)); guard >= 0) {
        pollfd ended{.fd = guard, .events = POLLIN, .revents = 0};
        poll(&ended, 1, 1000);
        close(guard);
    }
    waitpid(process_, nullptr, WNOHANG);
}

void Guard::say(GuardMessage message) {
    if (has_ended_) return;
    // A guard that takes nothing is noticed by the answers that fail to come.
    if (send(socket_, &message, 1, MSG_DONTWAIT | MSG_NOSIGNAL) < 0 && errno != EAGAIN && errno != EINTR)
        has_ended_ = true;
}

void Guard::beat(double now) {
    if (beats_ && now - beat_at_ < shortest_beat) return;
    beats_ = true;
    beat_at_ = now;
    if (asked_at_ == 0) asked_at_ = now;
    say(GuardMessage::beat);
}

void Guard::rest() {
    // A beat that has had no answer yet still wants it.
    if (!std::exchange(beats_, false)) return;
    say(GuardMessage::rest);
}

bool Guard::has_stopped() {
    bool stopped = false;
    std::array<GuardMessage, 64> messages{};
    for (;;) {
        const ssize_t count = recv(socket_, messages.data(), messages.size(), MSG_DONTWAIT);
        if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) has_ended_ = true;
        if (count <= 0) return stopped;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
            if (messages[i] == GuardMessage::stopped) stopped = true;
            asked_at_ = 0;
        }
        if (stopped) ++stops_;
    }
}

}  // namespace nezumi::hw

// Forks the guard and talks to it without blocking.
#include "hw/guard/guard.hpp"

#include <fcntl.h>
#include <linux/sockios.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/mutex.hpp"
#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

// Gives the guard its own descriptor: if the engine's descriptor hangs in a driver, another one may still work.
tl::expected<int, int> open_again(const std::string& path, int file) {
    const int again = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (again < 0) return tl::unexpected(errno);
    struct stat one {};
    struct stat other {};
    const bool is_same = fstat(file, &one) == 0 && fstat(again, &other) == 0 && one.st_dev == other.st_dev &&
                         one.st_ino == other.st_ino && one.st_rdev == other.st_rdev;
    if (is_same) return again;
    close(again);
    return tl::unexpected(ENODEV);
}

bool send_with(int socket, GuardOrder& order, int file) {
    iovec content{.iov_base = &order, .iov_len = sizeof order};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof file)> extra{};
    msghdr message{};
    message.msg_iov = &content;
    message.msg_iovlen = 1;
    message.msg_control = extra.data();
    message.msg_controllen = extra.size();
    cmsghdr* header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof file);
    std::memcpy(CMSG_DATA(header), &file, sizeof file);
    return sendmsg(socket, &message, MSG_DONTWAIT | MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof order);
}

// The sockets of all guards of this process. They are global, because the signal thread that ends the program has no
// access to the robots.
struct Sockets {
    Mutex mutex;
    std::vector<int> all;
};
Sockets& sockets() {
    static Sockets the;
    return the;
}

}  // namespace

Guard::Guard(Lease lease, int socket, pid_t process) : lease_(std::move(lease)), socket_(socket), process_(process) {
    const Lock lock(sockets().mutex);
    sockets().all.push_back(socket_);
}

void Guard::brake_all() {
    const Lock lock(sockets().mutex);
    const GuardOrder order{.kind = GuardOrder::Kind::brake};
    for (const int socket : sockets().all)
        send(socket, &order, offsetof(GuardOrder, node), MSG_DONTWAIT | MSG_NOSIGNAL);
    // Waits, because an order that is still in the socket is not executed yet.
    const double end = clock_seconds() + std::chrono::duration<double>(longest_braking).count();
    for (const int socket : sockets().all) {
        int waiting = 0;
        while (ioctl(socket, SIOCOUTQ, &waiting) == 0 && waiting > 0 && clock_seconds() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

Expected<std::unique_ptr<Guard>> Guard::start(const std::string& driver, const DevicePath& node) {
    const bool is_real = node.files().are_real();
    if (is_real && getpid() == 1)
        return failure(
            "motors: nezumi is process 1 of its container. When it ends, the container ends too, and the motor guard "
            "can't stop the motors. Start nezumi from a shell that ends later, for example: sh -c 'nezumi run ...; "
            "sleep 1'");
    auto taken = is_real ? Lease::take(driver, node.text()) : Lease::of_nothing();
    if (!taken) return Unexpected(taken.error());
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return failure(std::string("no guard process for the motors: ") + std::strerror(errno));
    const pid_t engine = getpid();
    const ProcessWords words = ProcessWords::of_this();
    const pid_t process = fork();
    if (process == 0) be_guard(ends[1], taken->file(), engine, words);
    close(ends[1]);
    if (process < 0) {
        close(ends[0]);
        return failure(std::string("no guard process for the motors: ") + std::strerror(errno));
    }
    return std::unique_ptr<Guard>(new Guard(std::move(*taken), ends[0], process));
}

Guard::~Guard() {
    {
        const Lock lock(sockets().mutex);
        std::erase(sockets().all, socket_);
    }
    close(socket_);
    kill(process_, SIGCONT);  // in case it was suspended
    // Waits for the guard's end, but not for a guard that hangs in the kernel.
    if (const int guard = static_cast<int>(syscall(SYS_pidfd_open, process_, 0)); guard >= 0) {
        pollfd ended{.fd = guard, .events = POLLIN, .revents = 0};
        poll(&ended, 1, 1000);
        close(guard);
    }
    waitpid(process_, nullptr, WNOHANG);
}

tl::expected<void, NodeError> Guard::take_up(const Node& node, const Stop& stop) {
    const auto failed = [&](int code) { return tl::unexpected(NodeError{node.path(), code}); };
    if (node.descriptor() < 0) return {};  // no real device
    GuardOrder order{.kind = GuardOrder::Kind::node};
    if (node.path().size() >= order.node.path.size()) return failed(ENAMETOOLONG);
    order.node.index = static_cast<std::uint8_t>(stop.index);
    order.node.proof = stop.proof;
    std::copy(stop.text.begin(), stop.text.end(), order.node.text.begin());
    std::copy(node.path().begin(), node.path().end(), order.node.path.begin());
    const auto file = open_again(node.path(), node.descriptor());
    if (!file) return failed(file.error());
    const bool is_sent = send_with(socket_, order, *file);
    const int problem = errno;
    close(*file);
    if (!is_sent) return failed(problem);
    if (stop.proof == Proof::none) return {};
    paths_.at(stop.index) = node.path();
    trouble_.reset();
    proved_at_ = -1;
    taken_up_at_ = clock_seconds();
    return {};
}

void Guard::say(GuardOrder::Kind kind, double now) {
    if (has_ended_) return;
    const GuardOrder order{.kind = kind, .tm = now};
    // A full socket is not an error here: if the guard does not receive, its answers are missing, which is noticed.
    const ssize_t sent = send(socket_, &order, offsetof(GuardOrder, node), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) has_ended_ = true;
}

void Guard::beat(double now) {
    if (beats_ && now - beat_at_ < shortest_beat) return;
    beats_ = true;
    beat_at_ = now;
    if (asked_at_ == 0) asked_at_ = now;
    say(GuardOrder::Kind::beat, now);
}

void Guard::rest() {
    // Without an earlier beat the guard rests already.
    if (!std::exchange(beats_, false)) return;
    say(GuardOrder::Kind::rest);
}

bool Guard::has_stopped() {
    bool stopped = false;
    for (;;) {
        GuardAnswer answer;
        const ssize_t length = recv(socket_, &answer, sizeof answer, MSG_DONTWAIT);
        if (length == 0 || (length < 0 && errno != EAGAIN && errno != EINTR)) has_ended_ = true;
        if (length <= 0) return stopped;
        asked_at_ = 0;
        if (answer.kind == GuardAnswer::Kind::stopped) stopped = true;
        // Ignores answers to beats from before the nodes were replaced.
        if (answer.kind == GuardAnswer::Kind::stopped || answer.tm < taken_up_at_) continue;
        if (answer.kind == GuardAnswer::Kind::proved) {
            proved_at_ = answer.tm;
            trouble_.reset();
        } else {
            trouble_ = NodeError{paths_.at(answer.index), answer.error};
        }
    }
}

}  // namespace nezumi::hw

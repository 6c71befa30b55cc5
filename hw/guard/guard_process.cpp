// Waits for beats, for the end of the socket, and for the death of the engine's thread that forked it.
#include "hw/guard/guard_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hw/device/clock.hpp"

namespace nezumi::hw {
namespace {

// A node that the guard stops: by its own descriptor, or by its path. An open descriptor still works if permissions, a
// mount or another node change its path. Allocates nothing.
struct GuardedNode {
    int file = -1;  // the guard's own descriptor, open for writing; -1: no node
    GuardOrder::Node what{};
};

// Returns 0 if the file still has its name; otherwise why not, as an `errno`.
int removal_of(int file) {
    struct stat status {};
    if (fstat(file, &status) != 0) return errno;
    return status.st_nlink == 0 ? ENOENT : 0;
}

bool write_text(int file, const char* text) {
    const std::size_t size = std::strlen(text);
    struct stat status {};
    const bool is_plain = fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    // A regular file that replaces a device contains only the last write.
    if (is_plain && ftruncate(file, 0) != 0) status = {};
    const ssize_t written = is_plain ? pwrite(file, text, size, 0) : write(file, text, size);
    return written == static_cast<ssize_t>(size);
}

// Replaces a node and closes its descriptor.
void take_up(GuardedNode& node, const GuardOrder::Node& what, int file) {
    if (node.file >= 0) close(node.file);
    node = {.file = file, .what = what};
}

// Why the guard could not stop the node now, as an `errno`; 0 if its proof succeeds.
int problem_of(const GuardedNode& node) {
    if (node.file < 0 || node.what.proof == Proof::none) return 0;
    if (node.what.proof == Proof::empty_write && write(node.file, "", 0) != 0) return errno;
    return removal_of(node.file);
}

void stop(const GuardedNode& node) {
    const char* text = node.what.text.data();
    if (write_text(node.file, text) && removal_of(node.file) == 0) return;
    const int file = open(node.what.path.data(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file < 0) return;
    write_text(file, text);
    close(file);
}

using Nodes = std::array<GuardedNode, GuardOrder::most_nodes>;

// Stops each node in a separate process, so that a node that hangs does not delay the others. Returns when all are
// written, or after `patience` [s].
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

void be_guard(int socket, int lease, pid_t engine, const ProcessWords& words) {
    const int death = become_guard(socket, lease, words);
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
        // After the order `brake`, stops the motors again at each order: the engine may have written to them since.
        if (brakes) {
            stop_all(nodes, socket);
            say(socket, {.kind = GuardAnswer::Kind::stopped});
        }
    }
    stop_all(nodes, socket);
    _exit(0);
}

}  // namespace nezumi::hw

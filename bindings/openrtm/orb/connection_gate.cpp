// omniORB has no limit for its connections and no hook for accepting one. Its sockets are found by their port. The
// kernel's data of each one show whether the ORB has ever answered. A descriptor may be closed and reused at any time,
// so a socket is shut down through a descriptor of our own, after a check that it is the same socket.
#include "bindings/openrtm/orb/connection_gate.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>

#include "engine/base/number_in.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::openrtm {
namespace {

// The largest number of connections that wait for accept; they are not counted in the limits.
constexpr int longest_queue = 32;
// The shortest and the longest time between two checks. The listening socket wakes the thread for most connections,
// but not for a connection that the ORB accepts before this thread has checked the socket.
constexpr std::chrono::milliseconds shortest_pause{1}, longest_pause{200};

struct End {
    std::string address{};
    std::uint16_t port = 0;
};

// Returns the address of one end of a TCP socket; nothing for any other file.
template <class Name>
std::optional<End> end_of(int file, const Name& name) {
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    if (name(file, reinterpret_cast<sockaddr*>(&storage), &size) != 0) return std::nullopt;
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (storage.ss_family == AF_INET) {
        sockaddr_in address{};
        std::memcpy(&address, &storage, sizeof address);
        inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
        return End{text.data(), ntohs(address.sin_port)};
    }
    if (storage.ss_family != AF_INET6) return std::nullopt;
    sockaddr_in6 address{};
    std::memcpy(&address, &storage, sizeof address);
    inet_ntop(AF_INET6, &address.sin6_addr, text.data(), text.size());
    return End{text.data(), ntohs(address.sin6_port)};
}

int option_of(int file, int option) {
    int value = 0;
    socklen_t size = sizeof value;
    return getsockopt(file, SOL_SOCKET, option, &value, &size) == 0 ? value : -1;
}

bool listens_at(int file, std::uint16_t port) {
    if (option_of(file, SO_TYPE) != SOCK_STREAM || option_of(file, SO_ACCEPTCONN) != 1) return false;
    const auto own = end_of(file, getsockname);
    return own && own->port == port;
}

std::optional<std::uint64_t> number_of(int file) {
    struct stat status {};
    if (fstat(file, &status) != 0) return std::nullopt;
    return status.st_ino;
}

// Calls `visit` for every descriptor of the process.
template <class Visit>
void for_each_file(DIR* files, const Visit& visit) {
    rewinddir(files);
    while (const dirent* entry = readdir(files)) {  // NOLINT(concurrency-mt-unsafe): of this stream alone
        if (const auto file = number_in<int>(entry->d_name)) visit(*file);
    }
}

}  // namespace

ConnectionGate::ConnectionGate(std::uint16_t port, ConnectionLimits limits)
    : port_(port), limits_(limits), files_(opendir("/proc/self/fd"), closedir), bell_(eventfd(0, EFD_CLOEXEC)) {
    rlimit descriptors{};
    if (getrlimit(RLIMIT_NOFILE, &descriptors) == 0)
        limits_.most_in_a_burst = std::min<std::size_t>(limits_.most_in_a_burst, descriptors.rlim_cur / 4);
    if (files_ == nullptr || bell_ < 0) return;
    for_each_file(files_.get(), [this](int file) {
        if (listener_ < 0 && listens_at(file, port_)) listener_ = fcntl(file, F_DUPFD_CLOEXEC, 0);
    });
    spare_ = fcntl(bell_, F_DUPFD_CLOEXEC, 0);
    if (listener_ < 0 || spare_ < 0 || listen(listener_, longest_queue) != 0) return;
    thread_ = start_thread([this] { run(); });
}

ConnectionGate::~ConnectionGate() {
    const std::uint64_t one = 1;
    if (thread_.joinable() && write(bell_, &one, sizeof one) > 0) thread_.join();
    for (const int file : {bell_, listener_, spare_}) {
        if (file >= 0) close(file);
    }
}

void ConnectionGate::run() {
    for (;;) {
        std::array<pollfd, 2> polled{{{bell_, POLLIN, 0}, {listener_, POLLIN, 0}}};
        const int events = poll(polled.data(), polled.size(), static_cast<int>(longest_pause.count()));
        if (events > 0 && polled[0].revents != 0) return;
        look();
        std::this_thread::sleep_for(shortest_pause);  // gives the ORB time to accept
    }
}

void ConnectionGate::look() {
    std::size_t all = 0;
    std::vector<Connection> open = connections(all);
    // The first ones to close come first.
    std::sort(open.begin(), open.end(), [](const Connection& a, const Connection& b) {
        return std::pair(a.was_used, b.unused) < std::pair(b.was_used, a.unused);
    });
    std::map<std::string, std::size_t> of_source;
    for (const Connection& each : open) ++of_source[each.source];
    auto unused =
        static_cast<std::size_t>(std::count_if(open.begin(), open.end(), [](const auto& c) { return !c.was_used; }));
    std::size_t left = open.size();
    for (const Connection& each : open) {
        const bool is_old = !each.was_used && (each.unused >= limits_.longest_unused || unused > limits_.most_unused);
        if (!is_old && left <= limits_.most && of_source[each.source] <= limits_.most_of_source) continue;
        end(each);
        --left;
        --of_source[each.source];
        if (!each.was_used) --unused;
    }
    accept_others(all < limits_.most_in_a_burst);
}

// The ORB's connections that are not closed by the peer; `all` counts those too.
std::vector<ConnectionGate::Connection> ConnectionGate::connections(std::size_t& all) {
    std::vector<Connection> open;
    for_each_file(files_.get(), [&](int file) {
        const auto own = end_of(file, getsockname);
        if (!own || own->port != port_ || option_of(file, SO_TYPE) != SOCK_STREAM) return;
        const auto peer = end_of(file, getpeername);
        const auto number = number_of(file);
        tcp_info info{};
        socklen_t size = sizeof info;
        if (option_of(file, SO_ACCEPTCONN) != 0) return;
        ++all;
        if (!peer || !number || getsockopt(file, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return;
        constexpr std::uint8_t established = 1;  // TCP_ESTABLISHED; its header conflicts with others
        if (info.tcpi_state != established) return;
        open.push_back({file, *number, peer->address, std::chrono::milliseconds(info.tcpi_last_data_recv),
                        info.tcpi_data_segs_out > 0});
    });
    return open;
}

void ConnectionGate::end(const Connection& connection) {
    if (dup3(connection.file, spare_, O_CLOEXEC) >= 0 && number_of(spare_) == connection.socket)
        shutdown(spare_, SHUT_RDWR);
    dup3(bell_, spare_, O_CLOEXEC);
}

// A kernel filter, which needs no privilege, drops packets that would open another connection.
void ConnectionGate::accept_others(bool accepts) {
    if (accepts == accepts_) return;
    std::array<sock_filter, 1> nothing{{{BPF_RET | BPF_K, 0, 0, 0}}};
    const sock_fprog program{static_cast<unsigned short>(nothing.size()), nothing.data()};
    const int none = 0;
    const int done = accepts ? setsockopt(listener_, SOL_SOCKET, SO_DETACH_FILTER, &none, sizeof none)
                             : setsockopt(listener_, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program);
    if (done == 0) accepts_ = accepts;
}

}  // namespace nezumi::openrtm

// Limits the connections to the ORB. Any peer can open many, and each uses a file descriptor of this process; consoles,
// motors, files and the page's STOP need descriptors too.
#pragma once

#include <dirent.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace nezumi::openrtm {

/// CORBA has no authentication, so unused connections are closed first. A connection counts as used after the first
/// answer on it. RTCs whose connection was closed connect again with their next call.
struct ConnectionLimits {
    // Above a limit, connections are closed: those that were never used first, and of these the oldest first.
    std::size_t most = 64;                            ///< connections in all
    std::size_t most_of_source = 32;                  ///< connections from one address
    std::size_t most_unused = 16;                     ///< connections that were never used
    std::chrono::milliseconds longest_unused{5'000};  ///< after this time a connection that was never used is closed
    std::size_t most_in_a_burst = 256;  ///< above it, or above a quarter of the process's descriptors, none is accepted
};

class ConnectionGate {
public:
    /// Watches the connections to a TCP port of this process on its own thread.
    explicit ConnectionGate(std::uint16_t port, ConnectionLimits limits = {});
    ~ConnectionGate();
    ConnectionGate(const ConnectionGate&) = delete;
    ConnectionGate& operator=(const ConnectionGate&) = delete;

private:
    struct Connection {
        int file = -1;             // of the process; may be reused by the next check,
        std::uint64_t socket = 0;  // so this number identifies the socket
        std::string source{};      // the peer's address
        std::chrono::milliseconds unused{};
        bool was_used = false;
    };

    void run();
    void look();
    std::vector<Connection> connections(std::size_t& all);
    void end(const Connection& connection);
    void accept_others(bool accepts);

    const std::uint16_t port_;
    ConnectionLimits limits_;
    std::unique_ptr<DIR, int (*)(DIR*)>
        files_;          // the process's descriptors; opened early while descriptors are available
    int bell_ = -1;      // an eventfd for the end
    int listener_ = -1;  // a copy of the ORB's listening socket
    int spare_ = -1;     // becomes the socket to shut down
    bool accepts_ = true;
    std::thread thread_;
};

}  // namespace nezumi::openrtm

// Limits connections to the ORB: any peer can open many, and each uses a descriptor of the process, which consoles,
// motors, files and the page's STOP also need.
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

/// CORBA has no authentication. A connection counts as used after the first answer on it. RTCs whose connection was
/// closed connect again with their next call.
struct ConnectionLimits {
    std::size_t most = 64;            ///< connections at once; above it the oldest unused one is closed,
    std::size_t most_of_source = 32;  ///< also above this number from one address
    std::size_t most_unused = 16;     ///< connections without a request; the oldest is closed first,
    std::chrono::milliseconds longest_unused{5'000};  ///< and each one after this time
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

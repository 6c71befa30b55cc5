// Keeps connections to the ORB few: whoever reaches its port can open as many as they like, and each takes a descriptor
// of the process, which consoles, motors, files and the page's STOP need as well.
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

/// CORBA knows no authentication: a connection on which something was answered is one that is used. RTCs whose
/// connection was ended connect again with their next call.
struct ConnectionLimits {
    std::size_t most = 64;                            ///< connections at once; above that the longest unused one goes,
    std::size_t most_of_source = 32;                  ///< as it does above so many of one address
    std::size_t most_unused = 16;                     ///< that have asked nothing yet; the oldest goes first,
    std::chrono::milliseconds longest_unused{5'000};  ///< and each goes after this
    std::size_t most_in_a_burst = 256;  ///< beyond these, or a quarter of the process's descriptors, none is accepted
};

class ConnectionGate {
public:
    /// Watches the connections to a port of TCP that this process listens at, in a thread of its own.
    explicit ConnectionGate(std::uint16_t port, ConnectionLimits limits = {});
    ~ConnectionGate();
    ConnectionGate(const ConnectionGate&) = delete;
    ConnectionGate& operator=(const ConnectionGate&) = delete;

private:
    struct Connection {
        int file = -1;             // of the process: may be another's by the time it is looked at again,
        std::uint64_t socket = 0;  // which this number tells
        std::string source{};      // the peer's address
        std::chrono::milliseconds unused{};
        bool was_used = false;
    };

    void run();
    bool look();
    std::vector<Connection> connections(std::size_t& all);
    void end(const Connection& connection);
    void accept_others(bool accepts);

    const std::uint16_t port_;
    ConnectionLimits limits_;
    std::unique_ptr<DIR, int (*)(DIR*)> files_;  // the process's descriptors: opened while there are some to be had
    int bell_ = -1;                              // an eventfd: the end
    int listener_ = -1;                          // the same socket as the ORB's
    int spare_ = -1;                             // becomes the socket that is to be ended
    bool accepts_ = true;
    std::thread thread_;
};

}  // namespace nezumi::openrtm

// HTTP and WebSocket on its own thread: a module that is loaded when a page is first served.
#pragma once

#include <memory>
#include <string>

#include "bindings/web/site.hpp"
#include "engine/base/error.hpp"

namespace nezumi::web {

class Sockets {
public:
    /// Gives browsers a short time to receive what waits for them, closes all connections and ends the thread.
    virtual ~Sockets() = default;
    virtual int port() const = 0;
    /// Makes the thread check for waiting messages and connections to close. Any thread may call it.
    virtual void wake() = 0;
};

struct SocketOptions {
    std::string address = "127.0.0.1";
    int first_port = 8765;               ///< 0: any free port
    int ports = 1;                       ///< number of ports to try, from the first
    std::size_t clients = most_clients;  ///< the most browsers at a time
    int relay = -1;                      ///< a socket for `open_relay`, which is used instead of a port; -1: none
    std::string certificate{}, key{};    ///< files for TLS, which is used instead of plain HTTP; "": plain HTTP
};

/// Starts to listen. `site` must outlive the sockets. An error gives the reason in one line.
Expected<std::unique_ptr<Sockets>> open_sockets(const SocketOptions& options, Site& site);

// The interface between the program and its module. Both are built together.
inline constexpr const char* web_module = "nezumi_sockets.so";
inline constexpr const char* open_in_module = "nezumi_open_sockets";
/// The only function that the module exports. Returns new sockets, or sets `problem` and returns nullptr. Never throws.
using OpenInModule = Sockets*(const SocketOptions& options, Site& site, std::string& problem);

}  // namespace nezumi::web

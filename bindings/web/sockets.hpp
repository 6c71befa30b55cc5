// Sockets that speak HTTP and WebSocket, in a thread of their own: a module that is loaded when a page is first served.
#pragma once

#include <memory>
#include <string>

#include "bindings/web/site.hpp"
#include "engine/base/error.hpp"

namespace nezumi::web {

class Sockets {
public:
    /// Gives browsers a moment to take what waits for them, closes all connections and ends the thread.
    virtual ~Sockets() = default;
    virtual int port() const = 0;
    /// Something may wait for a browser, or somebody is to be closed: has the thread ask. From any thread.
    virtual void wake() = 0;
};

struct SocketOptions {
    std::string address = "127.0.0.1";
    int first_port = 8765;             ///< 0: any that is free
    int ports = 1;                     ///< so many are tried, from the first on
    std::string certificate{}, key{};  ///< files with which TLS is spoken, and nothing else; "": plain HTTP
};

/// Begins to listen. `site` must outlive the sockets. The error says in one line why it can't.
Expected<std::unique_ptr<Sockets>> open_sockets(const SocketOptions& options, Site& site);

// What the program and its module know of each other: they are built together.
inline constexpr const char* web_module = "nezumi_sockets.so";
inline constexpr const char* open_in_module = "nezumi_open_sockets";
/// The module's one function: new sockets, or nullptr with the `problem`. It throws nothing.
using OpenInModule = Sockets*(const SocketOptions& options, Site& site, std::string& problem);

}  // namespace nezumi::web

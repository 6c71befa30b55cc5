// What is served to browsers, as the sockets' thread asks for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi::web {

/// A connection of a browser: 1, 2, ... in the order in which they came.
using ClientId = std::uint64_t;

/// The longest message of a browser [bytes]; a longer one closes its connection.
inline constexpr std::size_t longest_message = std::size_t{1} << 20;
/// Browsers at once, and of these such that may only look: they keep out none that may stop the robots.
inline constexpr std::size_t most_clients = 32;
inline constexpr std::size_t most_viewers = 24;

/// Of an HTTP request, what decides on the answer; "" for a header that is not there.
struct HttpRequest {
    std::string_view path;
    std::string_view host;
    std::string_view origin;
    std::string_view protocols;  ///< that a WebSocket offers
};

struct HttpReply {
    int status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body{};
    std::vector<std::pair<std::string, std::string>> headers{};  ///< besides type and length
};

/// Whether somebody is let in, and what they may.
struct Admission {
    int refused = 0;  ///< an HTTP status, or 0: let in
    bool view_only = false;
};

/// A message to a browser.
struct Outgoing {
    bool binary = false;
    std::string bytes{};
    bool closes = false;  ///< the connection is closed instead
};

/// All of it is called in the sockets' thread.
class Site {
public:
    virtual ~Site() = default;

    virtual HttpReply reply_to(const HttpRequest& request) = 0;
    /// Asked before a connection becomes a WebSocket.
    virtual Admission lets_in(const HttpRequest& request) = 0;
    virtual void opened(ClientId client, bool view_only) = 0;
    /// A whole message; false closes the connection.
    virtual bool received(ClientId client, std::string_view message) = 0;
    /// The next message to a browser that can take one; nothing when there is none.
    virtual std::optional<Outgoing> next(ClientId client) = 0;
    virtual void closed(ClientId client) = 0;
};

}  // namespace nezumi::web

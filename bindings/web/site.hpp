// The interface of the sockets' thread to what is served to browsers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi::web {

/// The number of a browser's connection: 1, 2, ... in order of connection.
using ClientId = std::uint64_t;

/// The longest message of a browser [bytes]; a longer one closes its connection.
inline constexpr std::size_t longest_message = std::size_t{1} << 20;
/// The most browsers at a time, and the most view-only ones of them. So view-only browsers can't take all places of
/// browsers that may stop the robots.
inline constexpr std::size_t most_clients = 32;
inline constexpr std::size_t most_viewers = 24;

/// The parts of an HTTP request that decide on the answer; "" for a missing header.
struct HttpRequest {
    std::string_view path;
    std::string_view host;
    std::string_view origin;
    std::string_view protocols;  ///< offered by a WebSocket
    std::string_view source{};   ///< for a WebSocket: the network address of the browser
};

struct HttpReply {
    int status = 200;
    std::string type = "text/plain; charset=utf-8";
    std::string body{};
    std::vector<std::pair<std::string, std::string>> headers{};  ///< in addition to the content's type and length
};

/// Whether a browser is admitted, and its permissions.
struct Admission {
    int refused = 0;  ///< an HTTP status, or 0: admitted
    bool view_only = false;
    int seat = 0;  ///< a number that only the site uses
};

/// A message to a browser.
struct Outgoing {
    bool binary = false;
    std::string bytes{};
    bool closes = false;  ///< true: nothing is sent, and the connection is closed
};

/// Called only in the sockets' thread.
class Site {
public:
    virtual ~Site() = default;

    virtual HttpReply reply_to(const HttpRequest& request) = 0;
    /// Called before a connection becomes a WebSocket.
    virtual Admission lets_in(const HttpRequest& request) = 0;
    virtual void opened(ClientId client, const Admission& admission) = 0;
    /// Takes a complete message; false closes the connection.
    virtual bool received(ClientId client, std::string_view message) = 0;
    /// Returns the next message to a browser that can receive one; nothing if there is none.
    virtual std::optional<Outgoing> next(ClientId client) = 0;
    virtual void closed(ClientId client) = 0;
};

}  // namespace nezumi::web

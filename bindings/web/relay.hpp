// Serves browsers that are connected to another program: frames over a socket to that program replace their
// connections.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bindings/web/sockets.hpp"

namespace nezumi::web {

/// A message about a browser between the two programs.
struct RelayFrame {
    enum class Kind : std::uint8_t {
        // from the program that has the browsers:
        opened,   ///< the browser has connected
        viewer,   ///< the browser has connected, and is view-only
        message,  ///< the browser has sent `bytes`
        ready,    ///< the browser can take one more message
        closed,   ///< the browser has disconnected
        // from the site, one for each `ready`:
        text,
        binary,
        closes,  ///< close the connection of the browser
    };
    Kind kind = Kind::closed;
    ClientId client = 0;
    std::string bytes{};
};

/// The number of the connection that the program with the browsers has for itself. Browsers have numbers from 1.
inline constexpr ClientId own_client = 0;

/// [bytes] of the longest frame: the picture of a floor.
inline constexpr std::size_t longest_relayed = (std::size_t{1} << 24) + 64;

/// Appends the bytes of the frame to `out`.
void append_frame(std::string& out, const RelayFrame& frame);

/// Puts frames together from pieces. The other side is not trusted.
class RelayReader {
public:
    void add(std::string_view piece) { waiting_ += piece; }
    /// The next complete frame; nothing if more bytes are needed, or after an error.
    std::optional<RelayFrame> next();
    /// True after a frame of an unknown kind or of too many bytes: nothing more can be read.
    bool is_broken() const { return broken_; }

private:
    std::string waiting_;
    std::size_t read_ = 0;  // of waiting_
    bool broken_ = false;
};

/// Serves the browsers of the program at the other end of `socket`, which stays open. When that program ends, this one
/// gets SIGTERM. `site` must outlive the result. An error gives the reason in one line.
Expected<std::unique_ptr<Sockets>> open_relay(int socket, Site& site);

}  // namespace nezumi::web

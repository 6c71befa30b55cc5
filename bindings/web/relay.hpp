// Browsers by way of another program: its frames over a socket stand for their connections.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bindings/web/sockets.hpp"

namespace nezumi::web {

/// What one side tells the other about a browser.
struct RelayFrame {
    enum class Kind : std::uint8_t {
        // from the program that has the browsers:
        opened,   ///< it has connected
        viewer,   ///< it has connected, and may only look
        message,  ///< it has sent `bytes`
        ready,    ///< it can take one more message
        closed,   ///< it has gone
        // from the site, one for each `ready`:
        text,
        binary,
        closes,  ///< its connection is to be closed
    };
    Kind kind = Kind::closed;
    ClientId client = 0;
    std::string bytes{};
};

/// The connection of the program itself that has the browsers: theirs have numbers from 1.
inline constexpr ClientId own_client = 0;

/// [bytes] of the longest frame: the picture of a floor.
inline constexpr std::size_t longest_relayed = (std::size_t{1} << 24) + 64;

/// Appends the frame to what is to be written.
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

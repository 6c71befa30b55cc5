// Cuts a stream of bytes into messages, and makes the bytes of a message.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi::hw {

/// How messages are separated. At most one of `end`, `length` and `cobs`; with none, each reading is a message.
struct Framing {
    std::string end{};       ///< the last bytes of each message, which are not part of it
    std::size_t length = 0;  ///< [bytes] of each message
    bool cobs = false;       ///< Consistent Overhead Byte Stuffing (Cheshire and Baker, 1999), each ended by a zero
};

std::string encode_cobs(std::string_view message);
/// Nothing if it is no COBS, as after a lost byte. `bytes` are without the zero at the end.
std::optional<std::string> decode_cobs(std::string_view bytes);

class Framer {
public:
    explicit Framer(Framing framing) : framing_(std::move(framing)) {}

    /// The messages that are complete with these bytes. Broken ones, and those longer than `longest`, are dropped.
    std::vector<std::string> take(std::string_view bytes);
    /// Forgets an incomplete message.
    void clear() { rest_.clear(); }
    /// The bytes of a message on the wire; nothing if it has a wrong length.
    std::optional<std::string> encode(std::string_view message) const;
    /// What ends a torn message.
    std::string end() const { return framing_.cobs ? std::string(1, '\0') : framing_.end; }

    static constexpr std::size_t longest = 4096;  ///< [bytes] of a received message

private:
    Framing framing_;
    std::string rest_;
};

}  // namespace nezumi::hw

// Splits a stream of bytes into messages, and encodes messages for it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nezumi::hw {

/// How messages are separated. At most one of `end`, `length` and `cobs` is set; without any, the bytes of each read
/// are a message.
struct Framing {
    std::string end{};       ///< the last bytes of each message, which are not part of it
    std::size_t length = 0;  ///< [bytes] of each message
    bool cobs = false;       ///< Consistent Overhead Byte Stuffing (Cheshire and Baker, 1999), each ended by a zero
};

std::string encode_cobs(std::string_view message);
/// Returns nothing if `bytes` are not valid COBS, for example after a lost byte. `bytes` are without the zero at the
/// end.
std::optional<std::string> decode_cobs(std::string_view bytes);

class Framer {
public:
    explicit Framer(Framing framing) : framing_(std::move(framing)) {}

    /// Adds bytes, and returns the messages that are now complete. Broken messages and those longer than `longest` are
    /// dropped.
    std::vector<std::string> take(std::string_view bytes);
    /// Forgets an incomplete message.
    void clear() { rest_.clear(); }
    /// Encodes a message for the wire; nothing if its length is wrong.
    std::optional<std::string> encode(std::string_view message) const;
    /// The bytes that end a torn message.
    std::string end() const { return framing_.cobs ? std::string(1, '\0') : framing_.end; }

    static constexpr std::size_t longest = 4096;  ///< [bytes] of a received message

private:
    Framing framing_;
    std::string rest_;
};

}  // namespace nezumi::hw

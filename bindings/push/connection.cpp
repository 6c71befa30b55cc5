// Sends texts between the two sides of a push. Each text is sent as its length, eight hexadecimal digits, and its
// bytes.
#include "bindings/push/connection.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>

#include "engine/base/number_in.hpp"
#include "engine/base/whole_file.hpp"

namespace nezumi::push {
namespace {

constexpr std::size_t length_digits = 8;
constexpr std::size_t longest_text = std::size_t{64} << 20;
constexpr std::size_t longest_line = 4096;

Unexpected gone() { return failure("the connection broke"); }

}  // namespace

Expected<void> PushConnection::put(std::string_view text) const {
    if (write_all(to_, fmt::format("{:0{}x}", text.size(), length_digits)) != 0 || write_all(to_, text) != 0)
        return gone();
    return {};
}

Expected<void> PushConnection::put_number(std::size_t number) const { return put(std::to_string(number)); }

Expected<std::string> PushConnection::take_bytes(std::size_t count) const {
    std::string text(count, '\0');
    for (std::size_t at = 0; at < count;) {
        pollfd polled{from_, POLLIN, 0};
        const int ready = poll(&polled, 1, longest_silence_);
        const ssize_t size = ready > 0 ? ::read(from_, text.data() + at, count - at) : ready;
        if (size < 0 && errno == EINTR) continue;
        if (size <= 0) return gone();
        at += static_cast<std::size_t>(size);
    }
    return text;
}

Expected<std::string> PushConnection::take() const {
    auto digits = take_bytes(length_digits);
    if (!digits) return digits;
    const auto length = number_in<std::size_t>(*digits, 16);
    if (!length || *length > longest_text)
        return failure(
            "expected an answer of nezumi on the other computer, got other text: does a shell there print something at "
            "its start?");
    return take_bytes(*length);
}

Expected<std::size_t> PushConnection::take_number() const {
    const auto text = take();
    if (!text) return Unexpected(text.error());
    const auto number = number_in<std::size_t>(*text);
    if (!number) return failure("expected a number from nezumi on the other computer, got other text");
    return *number;
}

Expected<std::string> PushConnection::take_line() const {
    std::string line;
    while (line.size() < longest_line) {
        auto byte = take_bytes(1);
        if (!byte) return byte;
        if (*byte == "\n") break;
        line += *byte;
    }
    return line;
}

}  // namespace nezumi::push

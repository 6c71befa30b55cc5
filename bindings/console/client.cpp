// Blocking reads and writes: a client has nothing else to do.
#include "bindings/console/client.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <utility>

namespace nezumi {

std::int64_t ConsoleClient::send(Request request) {
    request.id = ++last_id_;
    const std::string line = to_line(request);
    for (std::size_t sent = 0; sent < line.size() && is_open();) {
        const ssize_t count = ::send(socket_.get(), line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
        if (count > 0) sent += static_cast<std::size_t>(count);
        if (count < 0 && errno != EINTR) break;  // what it said last can still be read
    }
    return last_id_;
}

std::optional<Event> ConsoleClient::read_line() {
    while (fed_) {
        auto line = reader_.next();
        fed_ = line.has_value();
        if (!line || !*line) continue;
        if (auto event = read_event(**line)) return std::move(*event);
    }
    return std::nullopt;
}

std::optional<Event> ConsoleClient::next(int timeout) {
    for (;;) {
        if (auto event = read_line()) return event;
        if (!is_open()) return std::nullopt;
        pollfd waited{.fd = socket_.get(), .events = POLLIN, .revents = 0};
        const int found = poll(&waited, 1, timeout);
        if (found == 0 || (found < 0 && errno == EINTR)) return std::nullopt;
        std::array<char, 65536> piece{};
        const ssize_t got = recv(socket_.get(), piece.data(), piece.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) {
            close();
            continue;
        }
        reader_.feed({piece.data(), static_cast<std::size_t>(got)});
        fed_ = true;
    }
}

std::string without_controls(std::string_view text) {
    std::string plain;
    plain.reserve(text.size());
    for (std::size_t at = 0; at < text.size(); ++at) {
        const auto byte = static_cast<unsigned char>(text[at]);
        // U+0080 to U+009F are control characters as well, in two bytes.
        const bool second = byte == 0xC2 && at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xA0;
        if (!second && ((byte >= 0x20 && byte != 0x7F) || byte == '\n' || byte == '\t')) {
            plain += text[at];
            continue;
        }
        std::array<char, 8> written{};
        std::snprintf(written.data(), written.size(), "\\x%02x",
                      second ? static_cast<unsigned char>(text[++at]) : byte);
        plain += written.data();
    }
    return plain;
}

}  // namespace nezumi

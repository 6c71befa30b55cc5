// Blocking reads and writes, because a client has nothing else to do.
#include "bindings/console/client.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

namespace nezumi {

std::int64_t ConsoleClient::send(Request request) {
    request.id = ++last_id_;
    const std::string line = to_line(request);
    for (std::size_t sent = 0; sent < line.size() && is_open();) {
        const ssize_t count = ::send(socket_.get(), line.data() + sent, line.size() - sent, MSG_NOSIGNAL);
        if (count > 0) sent += static_cast<std::size_t>(count);
        if (count >= 0 || errno == EINTR) continue;
        if (errno == EPIPE || errno == ECONNRESET) break;  // the last messages can still be read
        close();                                           // no answer can come any more
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

bool ConsoleClient::is_answered(int timeout) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(timeout);
    const std::int64_t id = send({.kind = Request::Kind::is_complete, .text = "1"});
    while (is_open()) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
        if (left <= 0) return false;
        const auto event = next(static_cast<int>(left));
        if (event && event->id == id) return true;
    }
    return false;
}

}  // namespace nezumi

// A browser's connection on plain sockets, so that a test can send anything.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace nezumi {

class RawBrowser {
public:
    /// The content of one frame.
    struct Frame {
        int opcode = 0;  ///< 1 text, 2 binary, 8 close
        std::string bytes;
    };

    /// `meanwhile` is called while it waits. A small `buffer` [bytes] is full sooner; 0: the default.
    explicit RawBrowser(int port, std::function<void()> meanwhile, int buffer = 0)
        : meanwhile_(std::move(meanwhile)), file_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        if (buffer > 0) setsockopt(file_, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        connected_ = connect(file_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }
    RawBrowser(RawBrowser&& other) noexcept
        : meanwhile_(std::move(other.meanwhile_)),
          file_(std::exchange(other.file_, -1)),
          connected_(other.connected_),
          came_(std::move(other.came_)) {}
    RawBrowser& operator=(RawBrowser&&) = delete;
    ~RawBrowser() {
        if (file_ >= 0) close(file_);
    }

    bool is_connected() const { return connected_; }

    bool put(std::string_view bytes) {
        while (!bytes.empty()) {
            const ssize_t sent = send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            if (sent > 0) bytes.remove_prefix(static_cast<std::size_t>(sent));
            if (sent < 0 && errno != EAGAIN) return false;
            if (sent < 0 && !wait(POLLOUT)) return false;
        }
        return true;
    }

    /// Sends a request and returns the head of the answer, or "" if the connection ends without one.
    std::string ask(const std::string& lines) {
        if (!put(lines + "\r\n")) return "";
        std::size_t end = 0;
        while ((end = came_.find("\r\n\r\n")) == std::string::npos) {
            if (!read_more()) return std::exchange(came_, "");
        }
        std::string head = came_.substr(0, end + 2);
        came_.erase(0, end + 4);
        return head;
    }

    /// The rest until the connection ends or `size` bytes were received.
    std::string body(std::size_t size) {
        while (came_.size() < size && read_more()) {
        }
        return came_.substr(0, size);
    }

    /// Sends a masked frame as a browser does; `opcode` 1 is text.
    bool send_frame(std::string_view bytes, int opcode = 1, bool last = true) {
        std::string frame(1, static_cast<char>((last ? 0x80 : 0) | opcode));
        if (bytes.size() < 126) {
            frame += static_cast<char>(0x80 | bytes.size());
        } else if (bytes.size() < 65536) {
            frame += static_cast<char>(0x80 | 126);
            for (int shift = 8; shift >= 0; shift -= 8) frame += static_cast<char>(bytes.size() >> shift);
        } else {
            frame += static_cast<char>(0x80 | 127);
            for (int shift = 56; shift >= 0; shift -= 8) frame += static_cast<char>(bytes.size() >> shift);
        }
        const std::array<char, 4> mask{0x12, 0x34, 0x56, 0x78};
        frame.append(mask.data(), mask.size());
        for (std::size_t i = 0; i < bytes.size(); ++i) frame += static_cast<char>(bytes[i] ^ mask[i % 4]);
        return put(frame);
    }

    /// The next frame other than a ping (pings are answered); nothing if the connection ends or `seconds` pass.
    std::optional<Frame> next(double seconds = 20) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        for (;;) {
            if (auto frame = take_frame()) {
                if (frame->opcode != 9) return frame;
                if (!send_frame(frame->bytes, 10)) return std::nullopt;
                continue;
            }
            if (std::chrono::steady_clock::now() >= end) return std::nullopt;
            if (!read_more(end)) return std::nullopt;
        }
    }

    /// The next text that contains `what`; skips others; "" if none comes.
    std::string next_text(std::string_view what, double seconds = 20) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < end) {
            const auto frame = next(seconds);
            if (!frame || frame->opcode == 8) return "";
            if (frame->opcode == 1 && frame->bytes.find(what) != std::string::npos) return frame->bytes;
        }
        return "";
    }

    /// True if the other end closes the connection soon, perhaps after other messages.
    bool is_closed(double seconds = 20) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
        while (std::chrono::steady_clock::now() < end) {
            if (!read_more(end)) return ended_;
            came_.clear();
        }
        return false;
    }

private:
    using Until = std::chrono::time_point<std::chrono::steady_clock, std::chrono::duration<double>>;

    static Until in_20_seconds() { return std::chrono::steady_clock::now() + std::chrono::duration<double>(20); }

    bool wait(short what, Until end = in_20_seconds()) {
        while (std::chrono::steady_clock::now() < end) {
            meanwhile_();
            pollfd polled{.fd = file_, .events = what, .revents = 0};
            if (poll(&polled, 1, 2) > 0) return true;
        }
        return false;
    }
    bool read_more(Until end = in_20_seconds()) {
        if (!wait(POLLIN, end)) return false;
        std::array<char, 65536> piece{};
        const ssize_t got = recv(file_, piece.data(), piece.size(), 0);
        if (got <= 0) {
            ended_ = true;
            return false;
        }
        came_.append(piece.data(), static_cast<std::size_t>(got));
        return true;
    }
    std::optional<Frame> take_frame() {
        const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(came_[i]); };
        if (came_.size() < 2) return std::nullopt;
        std::size_t size = byte(1) & 127U, head = 2;
        if (size >= 126) {
            const std::size_t count = size == 126 ? 2 : 8;
            if (came_.size() < 2 + count) return std::nullopt;
            size = 0;
            for (std::size_t i = 0; i < count; ++i) size = size << 8 | byte(2 + i);
            head += count;
        }
        if (came_.size() < head + size) return std::nullopt;
        Frame frame{.opcode = byte(0) & 15, .bytes = came_.substr(head, size)};
        came_.erase(0, head + size);
        return frame;
    }

    std::function<void()> meanwhile_;
    int file_;
    bool connected_ = false;
    bool ended_ = false;
    std::string came_;
};

}  // namespace nezumi

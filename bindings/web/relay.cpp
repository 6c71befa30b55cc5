// A frame consists of its kind, the browser's number and the length in little endian, and the bytes.
#include "bindings/web/relay.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <set>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/descriptor.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::web {
namespace {

constexpr std::size_t head_size = 1 + 8 + 4;

void append_number(std::string& out, std::uint64_t number, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(number >> (8U * static_cast<unsigned>(i)));
}

std::uint64_t number_at(std::string_view text, std::size_t bytes) {
    std::uint64_t number = 0;
    for (std::size_t i = bytes; i-- > 0;) number = number << 8U | static_cast<unsigned char>(text[i]);
    return number;
}

// Serves the browsers of the other program. Calls all functions of the site in one thread.
class Relay final : public Sockets {
public:
    Relay(int socket, Site& site) : site_(site), socket_(socket), news_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
    ~Relay() override {
        ends_ = true;
        wake();
        if (thread_.joinable()) thread_.join();
    }
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;

    void start() {
        thread_ = start_thread([this] { serve(); });
    }
    int port() const override { return 0; }
    void wake() override { eventfd_write(news_.get(), 1); }

private:
    // Time for browsers to receive the rest when the run ends.
    static constexpr std::chrono::milliseconds farewell{300};

    void serve() {
        std::chrono::steady_clock::time_point end{};
        for (;;) {
            if (ends_ && end == std::chrono::steady_clock::time_point{})
                end = std::chrono::steady_clock::now() + farewell;
            if (ends_ && (clients_.empty() || std::chrono::steady_clock::now() > end)) return;
            std::array<pollfd, 2> files{{{socket_, POLLIN, 0}, {news_.get(), POLLIN, 0}}};
            poll(files.data(), files.size(), ends_ ? 20 : -1);
            eventfd_t none = 0;
            eventfd_read(news_.get(), &none);
            if (files[0].revents != 0 && !receive()) {
                if (!ends_) kill(getpid(), SIGTERM);
                return;
            }
            for (const ClientId client : std::vector(ready_.begin(), ready_.end())) {
                if (!send(client)) return;
            }
        }
    }

    // False: the other program has ended.
    bool receive() {
        std::array<char, 1 << 16> piece{};
        const ssize_t got = recv(socket_, piece.data(), piece.size(), MSG_DONTWAIT);
        if (got < 0) return errno == EAGAIN || errno == EINTR;
        if (got == 0) return false;
        reader_.add({piece.data(), static_cast<std::size_t>(got)});
        while (const auto frame = reader_.next()) {
            if (!take(*frame)) return false;
        }
        return !reader_.is_broken();
    }

    bool take(const RelayFrame& frame) {
        using Kind = RelayFrame::Kind;
        const ClientId client = frame.client;
        if (frame.kind == Kind::opened || frame.kind == Kind::viewer) {
            if (!clients_.insert(client).second) return true;
            site_.opened(client, {.refused = 0, .view_only = frame.kind == Kind::viewer});
        } else if (!clients_.contains(client)) {
            return true;
        } else if (frame.kind == Kind::message) {
            if (!site_.received(client, frame.bytes)) return close(client);
        } else if (frame.kind == Kind::ready) {
            ready_.insert(client);
        } else if (frame.kind == Kind::closed) {
            forget(client);
        }
        return true;
    }

    void forget(ClientId client) {
        clients_.erase(client);
        ready_.erase(client);
        site_.closed(client);
    }

    bool close(ClientId client) {
        forget(client);
        return write({.kind = RelayFrame::Kind::closes, .client = client});
    }

    bool send(ClientId client) {
        const auto message = site_.next(client);
        if (!message) return true;
        if (message->closes) return close(client);
        ready_.erase(client);
        return write({.kind = message->binary ? RelayFrame::Kind::binary : RelayFrame::Kind::text,
                      .client = client,
                      .bytes = message->bytes});
    }

    // Blocks until the frame is written. This is safe, because the other program always reads.
    bool write(const RelayFrame& frame) {
        std::string bytes;
        append_frame(bytes, frame);
        std::string_view rest = bytes;
        while (!rest.empty()) {
            const ssize_t sent = ::send(socket_, rest.data(), rest.size(), MSG_NOSIGNAL);
            if (sent < 0 && errno == EINTR) continue;
            if (sent <= 0) return false;
            rest.remove_prefix(static_cast<std::size_t>(sent));
        }
        return true;
    }

    Site& site_;
    const int socket_;
    Descriptor news_;
    std::atomic<bool> ends_ = false;
    RelayReader reader_;
    std::set<ClientId> clients_;
    std::set<ClientId> ready_;  // browsers that can take a message
    std::thread thread_;
};

}  // namespace

void append_frame(std::string& out, const RelayFrame& frame) {
    out += static_cast<char>(frame.kind);
    append_number(out, frame.client, 8);
    append_number(out, frame.bytes.size(), 4);
    out += frame.bytes;
}

std::optional<RelayFrame> RelayReader::next() {
    const std::string_view rest = std::string_view(waiting_).substr(read_);
    const auto waits = [&]() -> std::optional<RelayFrame> {
        waiting_.erase(0, std::exchange(read_, 0));
        return std::nullopt;
    };
    if (broken_ || rest.size() < head_size) return waits();
    const auto kind = static_cast<unsigned char>(rest[0]);
    const std::size_t length = number_at(rest.substr(9), 4);
    if (kind > static_cast<unsigned char>(RelayFrame::Kind::closes) || length > longest_relayed) {
        broken_ = true;
        return std::nullopt;
    }
    if (rest.size() < head_size + length) return waits();
    read_ += head_size + length;
    return RelayFrame{.kind = static_cast<RelayFrame::Kind>(kind),
                      .client = number_at(rest.substr(1), 8),
                      .bytes = std::string(rest.substr(head_size, length))};
}

Expected<std::unique_ptr<Sockets>> open_relay(int socket, Site& site) {
    int type = 0;
    socklen_t size = sizeof type;
    if (getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_STREAM)
        return failure("standard input is not the socket of a class");
    auto relay = std::make_unique<Relay>(socket, site);
    try {
        relay->start();
    } catch (const std::system_error& none) {
        return failure(std::string("can't start a thread for browsers: ") + none.what());
    }
    return relay;
}

}  // namespace nezumi::web

// UDP sockets.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/base/descriptor.hpp"
#include "hw/device/clock.hpp"
#include "hw/wire/wire_driver.hpp"

namespace nezumi::hw {

namespace {

class UdpWire final : public OpenWire {
public:
    UdpWire(Descriptor socket, std::string end) : socket_(std::move(socket)), end_(std::move(end)) {}

    tl::expected<double, int> read(std::vector<Arrived>& arrived) override {
        char buffer[4096];
        for (;;) {
            const ssize_t length = ::read(socket_.get(), buffer, sizeof buffer);
            if (length < 0 && errno == EINTR) continue;
            // ECONNREFUSED: no program of the device listens yet.
            if (length < 0 && (errno == EAGAIN || errno == ECONNREFUSED)) return 0.5;
            if (length < 0) return tl::unexpected(errno);
            std::string_view bytes(buffer, static_cast<std::size_t>(length));
            if (!end_.empty() && bytes.ends_with(end_)) bytes.remove_suffix(end_.size());
            arrived.push_back({clock_seconds(), std::string(bytes)});
        }
    }
    int watched_file() const override { return socket_.get(); }
    WriteTarget target() const override { return {.by = WriteBy::datagram, .file = socket_.get()}; }

private:
    Descriptor socket_;
    std::string end_;
};

class UdpDriver final : public WireDriver {
public:
    explicit UdpDriver(Parameters parameters) : parameters_(std::move(parameters)) {}

    Opened open() const override;
    OrWhy<std::string> encode(std::string_view message) const override { return std::string(message) + end(); }
    std::string end() const override { return value_of<std::string>(parameters_, "ends"); }

private:
    const Parameters parameters_;
};

Opened UdpDriver::open() const {
    const auto& host = value_of<std::string>(parameters_, "host");
    const auto port = [&](std::string_view name) {
        return htons(static_cast<std::uint16_t>(value_of<std::int64_t>(parameters_, name)));
    };
    const auto refuse = [&](std::string why) { return tl::unexpected(fmt::format("{}: {}", shown(host), why)); };
    sockaddr_in address{}, own{};
    address.sin_family = own.sin_family = AF_INET;
    address.sin_port = port("port");
    own.sin_port = port("local_port");
    if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
        return tl::unexpected(fmt::format("host: expected an address such as \"192.168.4.1\", got '{}'", shown(host)));
    if (address.sin_port == 0) return refuse("port: expected the device's port, 1 to 65535");
    Descriptor opened(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    if (opened.get() < 0) return refuse(std::strerror(errno));
    if (bind(opened.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0)
        return refuse(fmt::format("local_port {}: {}", ntohs(own.sin_port), std::strerror(errno)));
    if (connect(opened.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        return refuse(std::strerror(errno));
    return std::make_unique<UdpWire>(std::move(opened), end());
}

}  // namespace

DriverOrWhy udp_driver(const Parameters& parameters, const DeviceRoots& /*roots*/) {
    return std::make_unique<UdpDriver>(parameters);
}

}  // namespace nezumi::hw

// UDP sockets.
#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

#include "engine/base/names.hpp"
#include "hw/wire/endpoint.hpp"

namespace nezumi::hw {

Opened open_udp(const Parameters& parameters, const DeviceRoots& /*roots*/) {
    const auto host = parameters.find("host")->value.get<std::string>();
    const auto port = [&](std::string_view name) {
        return htons(static_cast<std::uint16_t>(parameters.find(name)->value.get<std::int64_t>()));
    };
    const auto refuse = [&](std::string why) { return tl::unexpected(fmt::format("{}: {}", shown(host), why)); };
    sockaddr_in address{}, own{};
    address.sin_family = own.sin_family = AF_INET;
    address.sin_port = port("port");
    own.sin_port = port("local_port");
    if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
        return tl::unexpected(fmt::format("host: expected an address such as \"192.168.4.1\", got '{}'", shown(host)));
    if (address.sin_port == 0) return refuse("port: expected the device's port, 1 to 65535");
    const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    if (file < 0) return refuse(std::strerror(errno));
    auto wire = std::make_unique<OpenWire>(file, false, true);
    if (bind(file, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0)
        return refuse(fmt::format("local_port {}: {}", ntohs(own.sin_port), std::strerror(errno)));
    if (connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        return refuse(std::strerror(errno));
    return wire;
}

}  // namespace nezumi::hw

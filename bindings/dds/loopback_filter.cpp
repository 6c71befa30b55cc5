// Cyclone DDS binds its receiving sockets to every address of the computer, regardless of its interface. The sockets
// are found by their ports. A kernel filter, which needs no privilege, checks each packet's interface.
#include "bindings/dds/loopback_filter.hpp"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace nezumi::dds {
namespace {

// The IPv4 port of a UDP socket that is bound to every address.
std::optional<std::uint16_t> open_port(int descriptor) {
    int type = 0;
    socklen_t size = sizeof type;
    if (getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return std::nullopt;
    sockaddr_in address{};
    size = sizeof address;
    if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
    if (address.sin_family != AF_INET || address.sin_addr.s_addr != INADDR_ANY) return std::nullopt;
    return ntohs(address.sin_port);
}

bool filter(int descriptor, unsigned int interface) {
    constexpr auto its_interface = static_cast<std::uint32_t>(SKF_AD_OFF + SKF_AD_IFINDEX);
    std::array<sock_filter, 4> program{{
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, its_interface},
        {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, interface},
        {BPF_RET | BPF_K, 0, 0, 0xffffffff},  // the whole packet
        {BPF_RET | BPF_K, 0, 0, 0},           // nothing
    }};
    const sock_fprog whole{static_cast<unsigned short>(program.size()), program.data()};
    return setsockopt(descriptor, SOL_SOCKET, SO_ATTACH_FILTER, &whole, sizeof whole) == 0;
}

}  // namespace

PortRange ports_of(std::uint32_t domain) {
    constexpr std::uint32_t first = 7400, of_a_domain = 250;
    return {static_cast<std::uint16_t>(first + of_a_domain * domain), of_a_domain};
}

int hear_loopback_only(PortRange ports) {
    const unsigned int loopback = if_nametoindex("lo");
    if (loopback == 0) return -1;
    int found = 0;
    std::error_code problem;
    std::filesystem::directory_iterator each("/proc/self/fd", problem);
    for (; !problem && each != std::filesystem::directory_iterator(); each.increment(problem)) {
        const std::string name = each->path().filename().string();
        int descriptor = -1;
        std::from_chars(name.data(), name.data() + name.size(), descriptor);
        const auto port = open_port(descriptor);
        if (!port || *port < ports.first || *port >= ports.first + ports.count) continue;
        if (!filter(descriptor, loopback)) return -1;
        ++found;
    }
    return problem ? -1 : found;
}

}  // namespace nezumi::dds

// Blocks packets of other computers on sockets that serve only this computer.
#pragma once

#include <cstdint>

namespace nezumi::dds {

/// UDP ports from `first` on.
struct PortRange {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
};

/// The ports of a domain (DDSI-RTPS 2.5, 9.6.2.3).
PortRange ports_of(std::uint32_t domain);

/// Restricts the sockets of this process that are bound to one of these ports at every address: they receive only
/// packets of the loopback, which include all packets of this computer. Returns the number of sockets, or -1 if a
/// socket can't be restricted.
int hear_loopback_only(PortRange ports);

}  // namespace nezumi::dds

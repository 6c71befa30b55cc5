// Keeps packets of other computers from sockets that are for this one alone.
#pragma once

#include <cstdint>

namespace nezumi::dds {

/// Ports of UDP, from `first` on.
struct PortRange {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
};

/// The ports of a domain (DDSI-RTPS 2.5, 9.6.2.3).
PortRange ports_of(std::uint32_t domain);

/// Every socket of this process that is bound to one of these ports at every address takes from now on only what comes
/// by the loopback, as all does that this computer sends itself. Returns how many sockets there are; -1: one can't be
/// so.
int hear_loopback_only(PortRange ports);

}  // namespace nezumi::dds

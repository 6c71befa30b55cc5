// One number for everything that ports published in a run: equal runs have equal hashes.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/system/system.hpp"

namespace nezumi {

/// Hashes every message of every port: port, tick and value. The order of ports does not matter, so a system file may
/// name its behaviours in another order.
class TraceHash final : public PortObserver {
public:
    void latched(const System& system) override;
    std::uint64_t value() const { return hash_; }

private:
    void take_names(const System& system);

    std::uint64_t hash_ = 0;
    std::vector<std::uint64_t> names_;  // the hash of each port's name, in the order of components and ports
    std::uint64_t layout_ = 0;          // of the system to which they belong
};

}  // namespace nezumi

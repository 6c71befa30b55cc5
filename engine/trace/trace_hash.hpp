// One number for everything that ports published in a run: equal runs have equal hashes.
#pragma once

#include <cstdint>

#include "engine/system/system.hpp"

namespace nezumi {

/// Hashes every message of every port: port, tick and value. The order of ports does not matter, so a system file may
/// name its behaviours in another order.
class TraceHash final : public PortObserver {
public:
    void latched(const System& system) override;
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0;
};

}  // namespace nezumi

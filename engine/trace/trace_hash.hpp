// One number for everything that ports published in a run: equal runs have equal hashes.
#pragma once

#include <cstdint>

#include "engine/system/system.hpp"

namespace nezumi {

/// Hashes every publication of every port: which port, in which tick, what. Compares runs on one machine only, because
/// the last bits of sines differ between processors. The order in which ports are told does not count: a system whose
/// file names its behaviours in another order is the same.
class TraceHash final : public PortObserver {
public:
    void latched(const System& system) override;
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0;
};

}  // namespace nezumi

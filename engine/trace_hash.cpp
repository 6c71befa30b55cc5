// Mixes publications into the hash in the order in which they are told.
#include "engine/trace_hash.hpp"

#include "engine/payload.hpp"

namespace nezumi {

void TraceHash::latched(const Component& component, const OutPortBase& port, const Time& now) {
    hash_ = mix(hash_, std::string_view(component.name()));
    hash_ = mix(hash_, std::string_view(port.name()));
    hash_ = port.hash_latched(mix(hash_, static_cast<std::uint64_t>(now.tick)));
}

}  // namespace nezumi

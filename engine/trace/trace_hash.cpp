// Each publication has a hash of its own, and their sum is that of the run.
#include "engine/trace/trace_hash.hpp"

#include "engine/ports/payload.hpp"

namespace nezumi {

void TraceHash::latched(const Component& component, const OutPortBase& port, const Time& now) {
    const std::uint64_t who = mix(mix(0, std::string_view(component.name())), std::string_view(port.name()));
    hash_ += port.hash_latched(mix(who, static_cast<std::uint64_t>(now.tick)));
}

}  // namespace nezumi

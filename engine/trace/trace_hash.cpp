// One hash of everything that ports published in a run. Each publication has its own hash; their sum is the hash of the
// run.
#include "engine/trace/trace_hash.hpp"

#include "engine/ports/payload.hpp"

namespace nezumi {

void TraceHash::latched(const System& system) {
    const std::int64_t tick = system.now().tick;
    for (const auto& component : system.components()) {
        const std::uint64_t owner = mix(0, std::string_view(component->name()));
        for (const auto& port : component->out_ports()) {
            if (port->latched_tick() != tick) continue;
            const std::uint64_t who = mix(owner, std::string_view(port->name()));
            hash_ += port->hash_latched(mix(who, static_cast<std::uint64_t>(tick)));
        }
    }
}

}  // namespace nezumi

// One hash of everything that ports published in a run. Each publication has its own hash; their sum is the hash of the
// run.
#include "engine/trace/trace_hash.hpp"

#include "engine/ports/payload.hpp"

namespace nezumi {

void TraceHash::latched(const System& system) {
    if (layout_ != system.layout()) take_names(system);
    const std::int64_t tick = system.now().tick;
    auto name = names_.begin();
    for (const auto& component : system.components()) {
        for (const auto& port : component->out_ports()) {
            const std::uint64_t who = *name++;
            if (port->latched_tick() == tick) hash_ += port->hash_latched(mix(who, static_cast<std::uint64_t>(tick)));
        }
    }
}

void TraceHash::take_names(const System& system) {
    layout_ = system.layout();
    names_.clear();
    for (const auto& component : system.components()) {
        const std::uint64_t owner = mix(0, std::string_view(component->name()));
        for (const auto& port : component->out_ports()) names_.push_back(mix(owner, std::string_view(port->name())));
    }
}

}  // namespace nezumi

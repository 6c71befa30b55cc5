// Keeps only numbers: texts and booleans have no curves.
#include "bindings/journal/field_curves.hpp"

#include "engine/tree/node.hpp"
#include "engine/values/walk.hpp"

namespace nezumi {

void FieldCurves::add(const std::string& port, const Value& message, double seconds) {
    visit_leaves(message, [&](const LeafPath& path, const ValueView& leaf) {
        if (!leaf.type->is_number()) return;
        std::string field = join_path(port, path.text());
        if (!fields_.empty() && !fields_.contains(field)) return;
        const double value = visit_number(leaf, [](const auto& number) { return static_cast<double>(number); });
        curves_[std::move(field)].emplace_back(seconds, value);
    });
}

const FieldCurves::Points& FieldCurves::of(const std::string& field) const {
    static const Points none;
    const auto found = curves_.find(field);
    return found == curves_.end() ? none : found->second;
}

std::vector<std::string> FieldCurves::names() const {
    std::vector<std::string> names;
    for (const auto& [name, points] : curves_) names.push_back(name);
    return names;
}

Expected<void> add_curves(FieldCurves& curves, Replay& replay, RunningSystem& live, int start) {
    live.activate();
    for (;;) {
        const auto more = replay.before_tick(live);
        if (!more) return Unexpected(more.error());
        if (!*more || live.when().start > start) return {};
        const bool is_of_start = live.when().start == start;
        live.tick();
        if (!is_of_start) continue;
        const System& system = std::as_const(live).system();
        for (const Component* component : system.components()) {
            for (const auto& port : component->out_ports()) {
                if (port->latched_tick() != system.last_tick().tick) continue;
                curves.add(path(*component, *port), port->value(), system.last_tick().seconds);
            }
        }
    }
}

}  // namespace nezumi

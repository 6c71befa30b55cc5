// Changes the system first, which may refuse, and then its description.
#include "engine/system/perform_on_spec.hpp"

#include <fmt/format.h>

#include "engine/robot/robot.hpp"

namespace nezumi {
namespace {

Unexpected no_world() { return failure("this works only in simulation, and there is no simulated world"); }

}  // namespace

Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const MoveMarker& act, const Actor& /*who*/) {
    if (system.world() == nullptr) return no_world();
    if (auto moved = system.world()->move_marker(act.marker, act.pose); !moved) return Unexpected(moved.error());
    for (MarkerSpec& marker : spec.arena.markers) {
        if (marker.name != act.marker) continue;
        marker.at = act.pose.position;
        marker.facing = act.pose.orientation.y;
    }
    return ActResult{};
}

Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const MoveThing& act, const Actor& /*who*/) {
    if (system.world() == nullptr) return no_world();
    if (auto moved = system.world()->move_thing(act.thing, act.pose); !moved) return Unexpected(moved.error());
    move_thing(spec.arena, act.thing, act.pose);
    return ActResult{};
}

Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const AddMarker& act, const Actor& /*who*/) {
    if (system.world() == nullptr) return no_world();
    if (system.find(act.marker.name) != nullptr)
        return failure(fmt::format("marker '{}': a component has this name: choose another", act.marker.name));
    if (auto added = system.world()->add_marker(act.marker); !added) return Unexpected(added.error());
    spec.arena.markers.push_back(act.marker);
    return ActResult{};
}

Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const RemoveMarker& act, const Actor& /*who*/) {
    if (system.world() == nullptr) return no_world();
    if (auto gone = system.world()->remove_marker(act.marker); !gone) return Unexpected(gone.error());
    std::erase_if(spec.arena.markers, [&](const MarkerSpec& each) { return each.name == act.marker; });
    return ActResult{};
}

Expected<ActResult> perform_on_spec(System& system, SystemSpec& spec, const Remove& act, const Actor& /*who*/) {
    const auto component = system.component(act.component);
    if (!component) return Unexpected(component.error());
    if (const auto* robot = dynamic_cast<const Robot*>(*component); robot != nullptr && robot->is_real())
        return failure(fmt::format("{} is a real robot: real robots can't be removed during a run", act.component));
    for (const ComponentEntry* carried : entries_of<ComponentEntry>(spec)) {
        if (carried->on == act.component)
            return failure(
                fmt::format("{} carries {}: remove the carried component first", act.component, carried->name));
    }
    ActResult result;
    const auto note = [&](const auto& ports) {
        for (const auto& port : ports) {
            const auto peers = system.peers(**component, *port);
            if (!peers.empty())
                result.notes.push_back(fmt::format("{}.{} is no longer connected to {}", act.component, port->name(),
                                                   fmt::join(peers, ", ")));
        }
    };
    note((*component)->in_ports());
    note((*component)->out_ports());
    if (auto gone = system.remove(act.component); !gone) return Unexpected(gone.error());
    std::erase_if(spec.entries, [&](const Entry& entry) { return name_of(entry) == act.component; });
    return result;
}

}  // namespace nezumi

// Finds components of a system that can be ticked independently.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/components/component.hpp"
#include "engine/system/wiring.hpp"

namespace nezumi {

/// Components that are connected to each other, directly or indirectly. Within a tick no group depends on another one,
/// so one goes through all phases before the next one starts: its memory stays in the cache.
struct Group {
    std::vector<Device*> devices;  ///< both in the order of the system's components
    std::vector<Component*> behaviors;
    std::size_t size() const { return devices.size() + behaviors.size(); }
};

/// The groups of all components: groups with at least `large` components first, otherwise in the order of their first
/// components.
std::vector<Group> group_components(const std::vector<std::unique_ptr<Component>>& components,
                                    const std::vector<Connection>& connections, std::size_t large);

}  // namespace nezumi

// Which components of a system can be ticked apart from each other.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/components/component.hpp"
#include "engine/system/wiring.hpp"

namespace nezumi {

/// Components that are wired to each other, directly or over others. Within a tick no group can tell what another one
/// does: each goes through the phases on its own, while its memory is near.
struct Group {
    std::vector<Device*> devices;  ///< both in the order of the system's components
    std::vector<Component*> behaviors;
    std::size_t size() const { return devices.size() + behaviors.size(); }
};

/// The groups of all components: those of at least `large` components first, otherwise in the order of their first
/// components.
std::vector<Group> group_components(const std::vector<std::unique_ptr<Component>>& components,
                                    const std::vector<Connection>& connections, std::size_t large);

}  // namespace nezumi

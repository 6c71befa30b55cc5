// Finds connected groups: a forest in which each component points to an earlier one.
#include "engine/system/groups.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "engine/robot/robot.hpp"

namespace nezumi {

std::vector<Group> group_components(const std::vector<std::unique_ptr<Component>>& components,
                                    const std::vector<Connection>& connections, std::size_t large) {
    // Each component points to an earlier one in its group, or to itself if it is the first.
    std::vector<std::size_t> earlier(components.size());
    std::iota(earlier.begin(), earlier.end(), std::size_t{0});
    const auto first_of = [&](std::size_t i) {
        while (earlier[i] != i) i = earlier[i] = earlier[earlier[i]];
        return i;
    };
    std::unordered_map<const Component*, std::size_t> index;
    for (std::size_t i = 0; i < components.size(); ++i) index.emplace(components[i].get(), i);
    const auto join = [&](const Component* one, const Component* other) {
        const std::size_t from = first_of(index.at(one)), to = first_of(index.at(other));
        earlier[std::max(from, to)] = std::min(from, to);
    };
    for (const Connection& connection : connections) join(connection.from_component, connection.to_component);
    for (const auto& component : components) {  // a twin reads the real robot in the same tick
        const auto* robot = dynamic_cast<const Robot*>(component.get());
        if (robot != nullptr && robot->real() != nullptr) join(robot, robot->real());
    }

    std::vector<Group> groups;
    std::vector<std::size_t> group(components.size());
    for (std::size_t i = 0; i < components.size(); ++i) {
        const std::size_t first = first_of(i);
        if (first == i) {
            group[i] = groups.size();
            groups.emplace_back();
        }
        Group& its = groups[group[first]];
        if (auto* device = dynamic_cast<Device*>(components[i].get())) {
            its.devices.push_back(device);
        } else {
            its.behaviors.push_back(components[i].get());
        }
    }
    std::stable_partition(groups.begin(), groups.end(), [large](const Group& g) { return g.size() >= large; });
    return groups;
}

}  // namespace nezumi

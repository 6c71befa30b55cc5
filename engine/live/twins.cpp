// Adds each twin as a normal entry with its own description.
#include "engine/live/twins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

namespace nezumi {

Expected<void> add_twins(SystemSpec& spec) {
    std::vector<Entry> entries;
    for (Entry& entry : spec.entries) {
        const auto* real = std::get_if<RobotEntry>(&entry);
        if (real == nullptr || !real->is_real()) {
            entries.push_back(std::move(entry));
            continue;
        }
        RobotEntry twin = *real;
        twin.name = real->name + "_twin";
        const auto taken = std::find_if(spec.entries.begin(), spec.entries.end(),
                                        [&](const Entry& other) { return name_of(other) == twin.name; });
        if (taken != spec.entries.end())
            return failure(fmt::format("the twin of '{}' has the name '{}': give this component another name",
                                       real->name, twin.name),
                           place_of(*taken));
        RobotSpec description = spec.models.at(real->described_by());
        std::erase_if(description.ports, [](const PortSpec& port) { return port.is_input; });
        for (ActuatorSpec& actuator : description.actuators) actuator.speed = 0;  // so the twin has no parameter for it
        description.drive.needs.clear();
        description.hardware = {};
        spec.models.insert_or_assign(twin.name, std::move(description));
        twin.description = twin.name;
        twin.backend = simulated;
        twin.twin_of = real->name;
        entries.push_back(std::move(entry));
        entries.emplace_back(std::move(twin));
    }
    if (entries.size() == spec.entries.size())
        return failure(fmt::format("{} has no real robot that could have a twin", spec.file));
    spec.entries = std::move(entries);
    return {};
}

}  // namespace nezumi

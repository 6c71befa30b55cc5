// Decides by the type and the owner of a port whether its messages may drive robots.
#include "engine/system/published.hpp"

#include <algorithm>

namespace nezumi {

bool commands_robots(const System& system, const OutPortBase& port) {
    if (port.type() != message_of<Velocity2D>()) return false;
    const auto robots = system.robots();
    return std::none_of(robots.begin(), robots.end(), [&](const Robot* robot) {
        const auto& own = robot->out_ports();
        return std::any_of(own.begin(), own.end(), [&](const OutPortBase* each) { return each == &port; });
    });
}

}  // namespace nezumi

// One line for each driver of a robot.
#include "hw/drivers.hpp"

#include "hw/raspimouse/mouse_body.hpp"

namespace nezumi::hw {

ByBackend<BodyMaker> drivers(const DeviceRoots& roots) {
    return {{"raspimouse",
             [roots](const RobotEntry& /*entry*/, const RobotSpec& spec) { return MouseBody::make(spec, roots); }}};
}

}  // namespace nezumi::hw

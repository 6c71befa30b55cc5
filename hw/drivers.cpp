// One line for each driver of a robot.
#include "hw/drivers.hpp"

#include "hw/ev3/ev3_body.hpp"
#include "hw/raspimouse/mouse_body.hpp"

namespace nezumi::hw {

ByBackend<BodyMaker> drivers(const DeviceRoots& roots) {
    return {
        {"raspimouse",
         [roots](const RobotEntry& /*entry*/, const RobotSpec& spec) { return MouseBody::make(spec, roots); }},
        {"ev3", [roots](const RobotEntry& /*entry*/, const RobotSpec& spec) { return Ev3Body::make(spec, roots); }}};
}

}  // namespace nezumi::hw

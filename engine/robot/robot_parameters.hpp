// The parameters of a robot, which result from its description.
#pragma once

#include <optional>

#include "engine/components/parameter.hpp"
#include "engine/world/robot_spec.hpp"

namespace nezumi {

/// The speed of a servo as a parameter, with the description's value as default; nothing for other actuators, or for a
/// servo that always turns as fast as it can.
inline std::optional<ParameterSpec> speed_parameter(const ActuatorSpec& actuator) {
    if (actuator.kind != ActuatorSpec::Kind::servo || actuator.speed <= 0) return std::nullopt;
    ParameterSpec speed{.name = actuator.name + "_speed",
                        .initial = actuator.speed,
                        .min = 0.001,
                        .unit = "rad/s",
                        .doc = "speed at which it turns to its angle"};
    if (actuator.max_rate > 0) speed.max = actuator.max_rate;
    return speed;
}

}  // namespace nezumi

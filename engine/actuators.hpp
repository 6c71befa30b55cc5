// What drives a robot's lights, buzzer and servos: their in-ports, and what silence on them means.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "engine/port.hpp"
#include "engine/robot_spec.hpp"
#include "engine/world.hpp"

namespace nezumi {

class Actuators {
public:
    /// How long [s] without a message is silence: as long as the drive waits for a velocity.
    static constexpr double silence = InPortBase::stale_after;

    /// `spec` must outlive this.
    explicit Actuators(const RobotSpec& spec);

    /// The message type that drives a kind of actuator; "" for a kind that no port drives yet.
    static std::string_view type_for(ActuatorSpec::Kind kind);
    /// Lets `port` drive actuator `index` of the spec. An error when the actuator has a port, or can't do what the
    /// description wants.
    Expected<void> add(std::size_t index, InPortBase& port, bool off_when_silent);

    /// Does what has arrived. One that its description wants off when nothing came for `silence` seconds goes off.
    void act(RobotBody& body, const Time& now, double tick_rate);
    /// Its robot is not ACTIVE: what makes noise stops, lights and angles hold.
    void be_still(RobotBody& body);

    const std::vector<bool>& leds() const { return leds_; }
    int buzzer_hertz() const { return buzzer_hertz_; }

private:
    struct Channel {
        std::size_t actuator;
        InPortBase* port;
        bool off_when_silent;
    };
    void set_leds(RobotBody& body, const std::vector<bool>& wanted);
    void set_buzzer(RobotBody& body, int hertz);
    void set_servo(RobotBody& body, std::size_t actuator, double angle);

    const RobotSpec& spec_;
    std::vector<Channel> channels_;
    std::vector<bool> leds_;
    int buzzer_hertz_ = 0;
};

}  // namespace nezumi

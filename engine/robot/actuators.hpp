// What drives a robot's lights, buzzer and servos: their in-ports, and what silence on them means.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/ports/port.hpp"
#include "engine/world/robot_spec.hpp"
#include "engine/world/world.hpp"

namespace nezumi {

class Actuators {
public:
    /// `spec` must outlive this.
    explicit Actuators(const RobotSpec& spec);

    /// The message type that drives a kind of actuator.
    static std::string_view type_for(ActuatorSpec::Kind kind);
    /// Lets `port` drive actuator `index` of the spec. An error when the actuator has a port, or can't do what the
    /// description wants.
    Expected<void> add(std::size_t index, InPortBase& port, bool off_when_silent);

    /// At what speed [rad/s] servo `index` of the spec turns from now on; 0: as fast as it can.
    void set_servo_speed(std::size_t index, double speed);

    /// Does what has arrived. One that its description wants off when nothing came for `silence` seconds goes off.
    /// `warn` is told of what can't be done, once for each port.
    void act(RobotBody& body, const Time& now, const std::function<void(std::string)>& warn);
    /// Servos stay where they are and all sound ends (of a body that is there already); what they are sent is ignored.
    void stop(RobotBody* body);
    /// They obey again what comes from now on.
    void rearm();
    /// Its robot is not ACTIVE: what makes noise stops, lights and angles hold.
    void be_still(RobotBody& body);

    const std::vector<bool>& leds() const { return leds_; }
    int buzzer_hertz() const { return buzzer_hertz_; }
    /// What the speaker was given, oldest first: the last `most_said` texts.
    const std::deque<std::string>& said() const { return said_; }
    static constexpr std::size_t most_said = 100;

private:
    struct Channel {
        std::size_t actuator;
        InPortBase* port;
        bool off_when_silent;
        double angle = 0;  // servo: [rad] to go to
        double speed = 0;  // servo: [rad/s] to turn at
        bool has_warned = false;
    };
    void set_leds(RobotBody& body, const std::vector<bool>& wanted);
    void set_buzzer(RobotBody& body, int hertz);
    void hold_servos(RobotBody& body);
    void aim_servo(RobotBody& body, Channel& channel, double angle) const;
    void show(RobotBody& body, Channel& channel, const std::function<void(std::string)>& warn);
    void play(RobotBody& body, const std::string& text);

    const RobotSpec& spec_;
    std::vector<Channel> channels_;
    std::vector<bool> leds_;
    int buzzer_hertz_ = 0;
    bool is_stopped_ = false;
    bool is_still_ = false;
    std::deque<std::string> said_;
};

}  // namespace nezumi

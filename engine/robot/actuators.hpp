// A robot's lights, buzzer and servos: their in-ports, and what happens without messages.
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
    /// `spec` must outlive this object.
    explicit Actuators(const RobotSpec& spec);

    /// The message type for a kind of actuator.
    static std::string_view type_for(ActuatorSpec::Kind kind);
    /// Connects `port` to actuator `index` of the spec. An error if the actuator already has a port, or if
    /// `off_when_silent` has no meaning for it.
    Expected<void> add(std::size_t index, InPortBase& port, bool off_when_silent);

    /// Sets the speed [rad/s] of servo `index` of the spec; 0: as fast as possible.
    void set_servo_speed(std::size_t index, double speed);

    /// Acts on received messages. Switches off actuators without a message for `silence` seconds, if their description
    /// wants this. `warn` gets what can't be done, once for each port.
    void act(RobotBody& body, const Time& now, const std::function<void(std::string)>& warn);
    /// Servos stop and sound ends (if there is a body already). Messages to servos, buzzer and speaker are ignored
    /// until `rearm`.
    void stop(RobotBody* body);
    /// Ends `stop`: messages that arrive from now on have an effect again.
    void rearm();
    /// For a robot that is not ACTIVE: sound ends and servos stop; lights do not change.
    void be_still(RobotBody& body);

    const std::vector<bool>& leds() const { return leds_; }
    int buzzer_hertz() const { return buzzer_hertz_; }
    /// The texts for the speaker, oldest first: the last `most_said`.
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

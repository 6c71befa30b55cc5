// The mouse's motors, their power and its buzzer, driven on their own thread under a guard.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/world/world.hpp"
#include "hw/device/health.hpp"
#include "hw/device/newest.hpp"
#include "hw/device/node.hpp"
#include "hw/device/worker.hpp"
#include "hw/guard/guard_watch.hpp"
#include "hw/raspimouse/motor_plan.hpp"
#include "hw/raspimouse/pulse_counter.hpp"
#include "hw/raspimouse/step_rate.hpp"

namespace nezumi::hw {

/// The pulses commanded to both motors, for the thread that reads the wheel counters.
struct CommandedWheels {
    CommandedPulses left, right;
    /// Increased when the driver's nodes were removed: then the motors' commands are lost too.
    std::atomic<int> driver_losses = 0;
};

/// The control loop's command for motors and buzzer.
struct MotorCommand {
    bool power = false;  ///< whether the motors may have power
    Wheels speeds;       ///< [m/s] of the rims
    int tone = 0;        ///< [Hz]; 0: silent
};

/// A job that executes the newest command. Motor power is off until a command needs it. It is switched off when no
/// command needs it, after some time of standstill, when the guard has stopped the robot, and when a motor fails. After
/// a failure both motors are stopped, and tried again every half second.
class Motors final : public DeviceJob {
public:
    /// Takes the robot's lease, starts the guard, stops all motors and switches their power off. `folder` has the
    /// nodes; `metres_per_pulse` is that of the rims; `acceleration` [m/s^2] is the limit; after `standing_power` [s]
    /// of standstill the power goes off until the next motion. Fails, with what to do, if another program drives the
    /// motors, or if the motors or their power can't be written.
    static Expected<std::unique_ptr<Motors>> make(const DevicePath& folder, Wheels metres_per_pulse,
                                                  double acceleration, double standing_power = 30);

    /// Called by the control loop at least once per tick. Without calls the guard stops the motors.
    void command(const MotorCommand& command) { newest_.put(command); }
    const std::shared_ptr<CommandedWheels>& commanded() const { return commanded_; }
    std::vector<std::string> take_faults();

    double run() override;
    int watched_file() const override;
    void end() override;

private:
    Motors(const DevicePath& folder, std::unique_ptr<Guard> guard, Wheels metres_per_pulse, double acceleration,
           double standing_power);
    /// Stops both motors and switches their power off, whatever their state is. Writes every node, even after an error.
    tl::expected<void, NodeError> stop_all();
    tl::expected<void, NodeError> be_guarded();
    void reopen(const std::string& why);
    bool has_to_stop(double now, bool they_turn);
    MotorState wanted(const MotorCommand& command, bool is_new, double now);
    bool perform(const MotorState& goal);
    bool write(const MotorWrite& write);
    void follow(const MotorState& state);
    void forget();

    GuardWatch guard_;
    Node power_, left_, right_, buzzer_;
    StepRate left_rate_, right_rate_;
    const double standing_power_;  // [s]
    // Shared with the counters, whose thread may be abandoned.
    std::shared_ptr<CommandedWheels> commanded_ = std::make_shared<CommandedWheels>();
    Health health_{"motors"}, buzzer_health_{"buzzer"};

    Newest<MotorCommand> newest_;
    int driver_losses_ = 0;
    MotorState state_;
    MotorState goal_;
    double served_at_ = 0;
    double moved_at_ = 0;  // when motion was last commanded, or power first wanted
    double retry_at_ = 0;  // while the motors are lost: time of the next try
    bool has_power_command_ = false;
    bool wants_power_ =
        false;  // of the newest command, which is executed after the guard has proved that it can stop the motors
};

}  // namespace nezumi::hw

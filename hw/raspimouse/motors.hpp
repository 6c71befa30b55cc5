// The mouse's motors, their power and its buzzer, driven on a thread of their own under a guard.
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
#include "hw/raspimouse/commanded_pulses.hpp"
#include "hw/raspimouse/motor_plan.hpp"
#include "hw/raspimouse/step_rate.hpp"

namespace nezumi::hw {

/// What both motors have been told, for those who count their pulses.
struct CommandedWheels {
    CommandedPulses left, right;
    /// Counted up by who finds that the driver's nodes have gone: what the motors were told is forgotten as well.
    std::atomic<int> driver_losses = 0;
};

/// What the control loop wants of motors and buzzer.
struct MotorCommand {
    bool power = false;  ///< whether the motors may have power
    Wheels speeds;       ///< [m/s] of the rims
    int tone = 0;        ///< [Hz]; 0: silent
};

/// A job: the newest command counts. Motor power is off until a command wants it, and again when one no longer does,
/// when the robot has stood for some time, when the guard has stopped it, and when a motor fails: then neither
/// turns, and both are tried again every half a second.
class Motors final : public DeviceJob {
public:
    /// Takes the robot's lease, starts the guard and has all motors stopped and without power. `folder` has the nodes.
    /// `metres_per_pulse` of the wheels' rims, `acceleration` [m/s^2] that the limits allow it, `standing_power` [s] of
    /// standstill after which the motors' power goes off, until they are to turn again. An error, with what to do, when
    /// another program drives the motors, or when motors or their power can't be written.
    static Expected<std::unique_ptr<Motors>> make(const DevicePath& folder, Wheels metres_per_pulse,
                                                  double acceleration, double standing_power = 30);

    /// From the control loop, once a tick at least: whoever falls silent is stopped by the guard.
    void command(const MotorCommand& command) { newest_.put(command); }
    const std::shared_ptr<CommandedWheels>& commanded() const { return commanded_; }
    std::vector<std::string> take_faults();

    double run() override;
    int watched_file() const override;
    void end() override;

private:
    Motors(const DevicePath& folder, std::unique_ptr<Guard> guard, Wheels metres_per_pulse, double acceleration,
           double standing_power);
    /// All motors stopped and without power, whatever they were: every node is written, also after one that failed.
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
    // Shared with the counters, whose thread may be left behind.
    std::shared_ptr<CommandedWheels> commanded_ = std::make_shared<CommandedWheels>();
    Health health_{"motors"}, buzzer_health_{"buzzer"};

    Newest<MotorCommand> newest_;
    int driver_losses_ = 0;
    MotorState state_;
    MotorState goal_;
    double served_at_ = 0;
    double moved_at_ = 0;  // when the wheels were last meant to turn, or power was first wanted
    double retry_at_ = 0;  // while they are lost: when to try again
    bool has_power_command_ = false;
    bool wants_power_ =
        false;  // of the newest command: the motors get it once the guard has proved that it can stop them
};

}  // namespace nezumi::hw

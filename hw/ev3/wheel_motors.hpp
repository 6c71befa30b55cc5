// The two drive motors of an EV3 with their encoders, on their own thread under a guard.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/world/world.hpp"
#include "hw/device/health.hpp"
#include "hw/device/newest.hpp"
#include "hw/device/sampler.hpp"
#include "hw/device/wheel_values.hpp"
#include "hw/device/worker.hpp"
#include "hw/ev3/tacho_motor.hpp"
#include "hw/guard/guard_watch.hpp"

namespace nezumi::hw {

/// A job that executes the newest command. A wheel with rate 0 is held. If a motor fails, both are stopped
/// independently, and are searched for every half second. The kernel stops a motor whose command is not repeated in
/// time, so the motors stop even if engine and guard are killed at the same time.
class WheelMotors final : public DeviceJob {
public:
    /// The command of the control loop.
    struct Command {
        bool drives = false;  ///< if false, the wheels roll freely
        Wheels rates;         ///< [pulses/s]
    };

    static constexpr std::size_t count = 2;

    /// Takes the brick's lease and starts the guard. `folder`: of the class; `ports`: of the left and the right motor;
    /// `acceleration`: a wheel's limit [pulses/s^2]. Fails, with what to do, if a motor is missing (then nothing was
    /// written) or if another program drives the motors.
    static Expected<std::unique_ptr<WheelMotors>> make(const DevicePath& folder,
                                                       const std::array<std::string, count>& ports,
                                                       double acceleration);
    /// The guard of these motors. Other motors of the brick may be added to it: their nodes have the index `count` and
    /// above.
    const std::shared_ptr<Guard>& guard() const { return guard_->guard(); }

    /// Called by the control loop at least once per tick. Without calls the motors are stopped.
    void command(const Command& command) { newest_.put(command); }
    /// The newest readings at `now` (`clock_seconds`), or nothing if they are not recent.
    std::optional<Sample<WheelValues>> newest(double now);
    std::vector<std::string> take_faults();
    /// True if a motor gives full power but does not reach its speed.
    bool is_stalled() const { return is_stalled_; }

    double run() override;
    int watched_file() const override { return guard_->file(); }
    void end() override;

private:
    struct Wheel {
        Wheel(const DevicePath& folder, const std::string& port) : motor(folder, "lego-ev3-l-motor", port) {}
        TachoMotor motor;
        PulseRate rate;
        enum class Mode { unknown, coast, hold, run } mode = Mode::unknown;  // of the last command
        int commanded_rate = 0;
        double commanded_at = 0;  // [s] time of the last run command
    };

    WheelMotors(const DevicePath& folder, const std::array<std::string, count>& ports, double acceleration)
        : wheels_{Wheel(folder, ports[0]), Wheel(folder, ports[1])}, acceleration_(acceleration) {}
    tl::expected<void, std::string> prepare();
    void stop_all();
    void lose(const NodeError& trouble);
    bool has_to_stop(double now, bool they_turn);
    double reachable(const Wheel& wheel, double rate, double elapsed) const;
    tl::expected<void, std::string> tell(Wheel& wheel, const Command& command, double rate, double now);
    tl::expected<void, std::string> perform(const Command& command, double now);
    tl::expected<void, std::string> read_positions();
    void look_for_stalls(double now);
    bool turns() const;

    std::array<Wheel, count> wheels_;  // left, right
    const double acceleration_;        // [pulses/s^2]
    std::unique_ptr<GuardWatch> guard_;
    Health health_{"motors"};
    Health stalls_{"motors"};
    std::atomic<bool> is_stalled_ = false;
    double looked_at_ = 0;  // [s] when the motors' states were read last

    Newest<Command> newest_;
    NewestSample<WheelValues> sample_;
    double served_at_ = 0;
    double retry_at_ = 0;  // [s] while the motors are lost: time of the next search
    bool wants_to_turn_ =
        false;  // of the newest command, which is executed after the guard has proved that it can stop the motors
};

}  // namespace nezumi::hw

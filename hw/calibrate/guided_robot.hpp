// A robot that a sub-command drives without behaviours, for tests and calibration.
#pragma once

#include <csignal>
#include <functional>
#include <memory>
#include <string>

#include "engine/base/error.hpp"
#include "engine/base/log.hpp"
#include "engine/system/build_system.hpp"
#include "engine/system/pacer.hpp"
#include "engine/system/system.hpp"

namespace nezumi::hw {

class GuidedRobot {
public:
    struct Options {
        bool real_time = true;                              ///< real robots need it
        const volatile std::sig_atomic_t* end = nullptr;    ///< if not 0, the work ends as soon as the robot stands
        std::function<void(const LogLine& line)> log = {};  ///< optional
    };

    /// Builds a system of this robot only, in the arena of `spec`. Errors as of `build_system`.
    static Expected<std::unique_ptr<GuidedRobot>> make(SystemSpec spec, const std::string& name, const Makers& makers,
                                                       Options options);
    /// Stops the robot and switches its motors off.
    ~GuidedRobot();
    GuidedRobot(const GuidedRobot&) = delete;
    GuidedRobot& operator=(const GuidedRobot&) = delete;

    /// Called after each tick of a drive.
    using EachTick = std::function<void()>;

    /// Drives with this velocity for `seconds`, or until `reached` returns true, then brakes to standstill. Fails if
    /// the person ends the program.
    Expected<void> drive(const Velocity2D& velocity, double seconds, const std::function<bool()>& reached = {},
                         const EachTick& each_tick = {});
    /// The robot stands for `seconds`, held by its motors.
    Expected<void> stand(double seconds, const EachTick& each_tick = {}) { return drive({}, seconds, {}, each_tick); }

    /// Switches the motors off until the next drive: the robot may be carried, and no ticks are needed.
    void rest();

    const Robot& robot() const { return *robot_; }
    /// The system as built, with the calibrated descriptions of its robots.
    const SystemSpec& spec() const { return spec_; }
    System& system() { return *system_; }

private:
    GuidedRobot(SystemSpec spec, Options options) : spec_(std::move(spec)), options_(std::move(options)) {}
    void tick();

    SystemSpec spec_;  // must outlive the system
    Options options_;
    std::unique_ptr<System> system_;
    std::unique_ptr<Pacer> pacer_;
    Robot* robot_ = nullptr;
    bool is_waking_ = false;
    InPort<Velocity2D>* velocity_ = nullptr;
};

}  // namespace nezumi::hw

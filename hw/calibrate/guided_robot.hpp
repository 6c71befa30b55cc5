// A robot that a sub-command drives by itself, with no behaviour: to check it, or to calibrate it.
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
        bool real_time = true;                              ///< as real robots want it
        const volatile std::sig_atomic_t* end = nullptr;    ///< not 0: everything ends as soon as it stands
        std::function<void(const LogLine& line)> log = {};  ///< may be empty
    };

    /// Builds a system of this robot alone, in the arena of `spec`. Errors as of `build_system`.
    static Expected<std::unique_ptr<GuidedRobot>> make(SystemSpec spec, const std::string& name, const Makers& makers,
                                                       Options options);
    /// It stands, and its motors have no power.
    ~GuidedRobot();
    GuidedRobot(const GuidedRobot&) = delete;
    GuidedRobot& operator=(const GuidedRobot&) = delete;

    /// Called after each tick of a drive.
    using EachTick = std::function<void()>;

    /// Drives with this velocity for so long [s], or until `reached`, and brakes until it stands. An error when it was
    /// asked to end.
    Expected<void> drive(const Velocity2D& velocity, double seconds, const std::function<bool()>& reached = {},
                         const EachTick& each_tick = {});
    /// Stands for so long [s], with its motors holding it.
    Expected<void> stand(double seconds, const EachTick& each_tick = {}) { return drive({}, seconds, {}, each_tick); }

    /// Its motors have no power until the next drive: it may be carried, and nobody has to tick.
    void rest();

    const Robot& robot() const { return *robot_; }
    /// The system as it was built, with the calibrated descriptions of its robots.
    const SystemSpec& spec() const { return spec_; }
    System& system() { return *system_; }

private:
    GuidedRobot(SystemSpec spec, Options options) : spec_(std::move(spec)), options_(std::move(options)) {}
    void tick();

    SystemSpec spec_;  // outlives the system
    Options options_;
    std::unique_ptr<System> system_;
    std::unique_ptr<Pacer> pacer_;
    Robot* robot_ = nullptr;
    bool is_waking_ = false;
    InPort<Velocity2D>* velocity_ = nullptr;
};

}  // namespace nezumi::hw

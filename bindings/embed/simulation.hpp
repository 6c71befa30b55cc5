// Simulates a system file in a program with its own loop.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/log.hpp"
#include "engine/live/running_system.hpp"
#include "engine/system/system.hpp"

namespace nezumi {

/// The options for simulated systems: with ODE's world and all native components. `installed` are folders like
/// PREFIX/share/nezumi, with `behaviors/` and `engine/robots/`; they are searched after the project's own files. A
/// library without simulation (NEZUMI_SIMULATION=OFF) gives no `world` and can't simulate a robot.
LiveOptions simulated_systems(std::vector<std::filesystem::path> installed);

/// Writes sounds of simulated robots as WAV files to this folder, which is made if missing.
void keep_sounds(LiveOptions& live, const std::string& folder);

class Simulation {
public:
    struct Options {
        std::vector<std::filesystem::path> installed;  ///< as in `simulated_systems`
        std::function<void(const LogLine&)> log;       ///< gets log lines; optional
    };

    /// Reads a system file, builds the system and activates it at time 0. Returns the first error of the file, with
    /// its location.
    static Expected<Simulation> load(const std::filesystem::path& file, Options options);
    /// Like `load`. In `options`, the program can add its own factories of components and drivers to those of
    /// `simulated_systems`.
    static Expected<Simulation> load_with(const std::filesystem::path& file, LiveOptions options);

    /// Runs one tick. Also checks a gamepad's emergency stop button, if a joystick component has one.
    void tick() { live_->tick(); }
    /// Runs the number of ticks in this simulated time [s].
    void run(double seconds);
    /// Simulated time [s].
    double now() const { return system().now().seconds; }

    /// Performs an act, between two ticks.
    Expected<ActResult> act(const Act& act) { return live_->act(act, {Actor::Kind::run}); }
    /// Read access to components, robots, ports and the world.
    const System& system() const { return live_->system(); }
    /// The running system, for a `RunLoop`, which ticks in real time, and for the buttons of robots
    /// (engine/live/robot_buttons.hpp).
    RunningSystem& running() { return *live_; }

private:
    explicit Simulation(std::unique_ptr<RunningSystem> live) : live_(std::move(live)) {}

    std::unique_ptr<RunningSystem> live_;
};

}  // namespace nezumi

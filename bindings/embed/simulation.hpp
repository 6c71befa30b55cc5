// A system file, simulated by whoever has a loop of their own.
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

/// How systems are made in simulation: with ODE's world and all native components. `installed` are folders like
/// PREFIX/share/nezumi, which have `behaviors/` and `engine/robots/`: looked at after the project's own files. A
/// library that is built without simulation (NEZUMI_SIMULATION=OFF) has no `world` in them, and can simulate no robot.
LiveOptions simulated_systems(std::vector<std::filesystem::path> installed);

/// Has what simulated robots say become WAV files in this folder, which is made when it is not there.
void keep_sounds(LiveOptions& live, const std::string& folder);

class Simulation {
public:
    struct Options {
        std::vector<std::filesystem::path> installed;  ///< as in `simulated_systems`
        std::function<void(const LogLine&)> log;       ///< takes what is logged; may be empty
    };

    /// Reads a system file, builds what it says and activates it, at time 0. The error is the file's first, with its
    /// place.
    static Expected<Simulation> load(const std::filesystem::path& file, Options options);
    /// The same with makers of the program's own beside those of `simulated_systems`: components, drivers of devices.
    static Expected<Simulation> load_with(const std::filesystem::path& file, LiveOptions options);

    /// Runs one tick. A gamepad's button for emergency stops counts, where a joystick names one.
    void tick() { live_->tick(); }
    /// Runs as many ticks as these simulated seconds have.
    void run(double seconds);
    /// [s] of simulated time.
    double now() const { return system().now().seconds; }

    /// Changes it, between two ticks.
    Expected<ActResult> act(const Act& act) { return live_->act(act, {Actor::Kind::run}); }
    /// Components, robots, ports and the world, to look at.
    const System& system() const { return live_->system(); }
    /// For a `RunLoop`, which ticks by the clock, and the buttons of robots (engine/live/robot_buttons.hpp).
    RunningSystem& running() { return *live_; }

private:
    explicit Simulation(std::unique_ptr<RunningSystem> live) : live_(std::move(live)) {}

    std::unique_ptr<RunningSystem> live_;
};

}  // namespace nezumi

// A run as `nezumi run --headless --speed max` makes it, from the text of a system file.
#pragma once

#include <cstdlib>
#include <memory>
#include <string>

#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "engine/project/project_files.hpp"
#include "engine/system/build_system.hpp"
#include "engine/trace/trace_hash.hpp"
#include "sim/world.hpp"
#include "tests/bench/report.hpp"

namespace nezumi::bench {

/// What `expected` holds; ends the benchmark with the error when it holds none.
template <class T>
T must(Expected<T> expected) {
    if (expected) return std::move(*expected);
    std::fprintf(stderr, "%s\n", describe(expected.error()).c_str());
    std::exit(2);
}

/// The tutorial's system, but that the mouse drives a circle: it sees the wall, and never comes so near that it stops.
inline constexpr const char* mouse_text = R"(
arena { box { at = { 0.55, 0.1, 0.15 }, size = { 0.1, 1.0, 0.3 } } }
robot    "mouse"      { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
behavior "controller" { script = "robot_controller", config = { speed_x = 0.1, speed_r = 0.8 } }
connect("mouse.ir_sensor_out", "controller.in")
connect("controller.out", "mouse.target_velocity_in")
)";

struct WholeEngine {
    ChunkCache chunks;
    SystemSpec spec;
    std::unique_ptr<System> system;
    double read_seconds = 0;   ///< [s] of CPU time: the system file and the robot's
    double build_seconds = 0;  ///< [s] of CPU time: world, robots, scripts, connections, activation

    /// `text` is that of a system file in `behaviors/systems`.
    explicit WholeEngine(const std::string& text, int threads = 1) {
        const std::string file = NEZUMI_SOURCE_ROOT "/behaviors/systems/benchmark.lua";
        const FileSnapshot files(disk());
        const Project project = Project::of(file, {NEZUMI_SOURCE_ROOT}, files);
        read_seconds = time_of([&] { spec = must(read_system_text(text, file, project, {.seconds = 60})); });
        const BehaviorSettings settings{.project = project, .budget = headless_budget, .chunks = &chunks};
        Makers makers;
        makers.world = sim::make_world;
        makers.behavior = [&](const BehaviorEntry& entry, const MakerContext& context) {
            return make_behavior(entry, context, settings);
        };
        BuildOptions options;
        options.threads = threads;
        options.out_of_time_is_fatal = true;
        options.log = [](const LogLine& line) { std::fprintf(stderr, "%s\n", line.text.c_str()); };
        build_seconds = time_of([&] {
            system = must(build_system(spec, makers, options));
            activate_all(*system, spec);
        });
    }

    void run(int ticks) {
        for (int i = 0; i < ticks; ++i) system->tick();
        if (system->fatal_error()) {
            std::fprintf(stderr, "%s\n", describe(*system->fatal_error()).c_str());
            std::exit(2);
        }
    }
};

}  // namespace nezumi::bench

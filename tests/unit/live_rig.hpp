// A live system from texts: a system file and behaviours in a scratch folder, simulated, and what it said.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "bindings/lua/reload/lua_host.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/live/running_system.hpp"
#include "sim/world.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/peer_words.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi {

/// A behaviour with a port whose name is a keyword, parameters, commands and a state.
inline const std::string counter_behavior = R"(
local range = input("in", "TimedShortSeq", "numbers")
local target = output("out", "TimedVelocity2D", "velocity")
param("speed_x", 0.25, { min = -1.5, max = 1.5, unit = "m/s", doc = "straight-ahead speed" })
param("stop_d", 30)
param("gains", { 1.0, 0.5 })
state.count = 0
state.list = { 1, { deep = true } }
command("add", function(a, b) state.count = state.count + a return state.count, b end, "counts up")
command("fail", function() error("no luck") end)
command("both", function() target:write { vx = 1, va = "x" } end)
function on_execute()
  for _, value in ipairs(range:read()) do
    if value > config.stop_d then return target:write {} end
  end
  target:write { vx = config.speed_x }
end
)";

inline const std::string counter_system = R"(
arena { box { at = { 0.8, 0.0, 0.15 }, size = { 0.1, 1.0, 0.3 } } }
robot    "mouse"      { model = "raspimouse" }
behavior "controller" { script = "counter", sets = { fast = { speed_x = 0.5 }, slow = { speed_x = 0.125 } } }
connect("mouse.ir_sensor_out", "controller.in")
connect("controller.out", "mouse.target_velocity_in")
)";

struct LiveRig {
    explicit LiveRig(const std::string& system = counter_system,
                     const std::map<std::string, std::string>& behaviors = {{"counter", counter_behavior}},
                     const ProjectFiles& files = disk(), const BuildOptions& build = {}) {
        for (const auto& [name, text] : behaviors) folder.write("behaviors/" + name + ".lua", text);
        file = folder.write("system.lua", system);
        LiveOptions options;
        options.scripts = &lua_scripts();
        options.peer_words = peer_words();
        options.files = &files;
        options.installed = {source_root()};
        options.world = sim::make_world;
        options.components = {{"Joystick", {{"sim", make_joystick}}}};
        options.build = build;
        options.build.log = [this](const LogLine& line) { log.push_back(line); };
        auto loaded = RunningSystem::load(file, std::move(options));
        if (!loaded) throw std::runtime_error(describe(loaded.error()));
        live = std::move(*loaded);
        live->activate();
    }

    void tick(int count = 1) {
        for (; count > 0; --count) live->tick();
    }
    // Past the one door through which systems are changed: only tests have this key.
    Component& component(const std::string& name) {
        const Component* found = live->system().find(name);
        if (found == nullptr) throw std::runtime_error("there is no component " + name);
        return const_cast<Component&>(*found);
    }
    bool said(const std::string& text) const {
        for (const LogLine& line : log) {
            if (line.text.find(text) != std::string::npos) return true;
        }
        return false;
    }

    Scratch folder;
    std::filesystem::path file;
    std::vector<LogLine> log;
    std::unique_ptr<RunningSystem> live;
};

}  // namespace nezumi

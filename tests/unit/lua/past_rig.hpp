// A system whose past is hard to compute again, and what the tests of the past do to it.
#pragma once

#include <catch2/catch.hpp>

#include <string>

#include "engine/live/past_run.hpp"
#include "tests/unit/live_rig.hpp"

namespace nezumi {

inline const Actor user{Actor::Kind::console};

// What a script has in memory, a task in the middle of a wait, random numbers and a noisy sensor.
inline const std::string past_behavior = R"(
local range = input("in", "TimedShortSeq", "numbers")
local target = output("out", "TimedVelocity2D", "velocity")
param("speed", 0.1, { min = -1, max = 1 })
local shared = { 0 }
state.a, state.b, state.steps = shared, shared, 0
command("kick", function() state.a[1] = state.a[1] + 100 end, "")
task("patrol", function()
  wait(0.37)
  state.steps = state.steps + 1
  wait_until(function() return range:read()[1] and range:read()[1] > 0 end, { within = 0.21 })
end, { repeating = true })
function on_execute()
  state.a[1] = state.a[1] + 1
  local turn = math.random() - 0.5 + state.b[1] * 1e-4
  target:write { vx = config.speed, va = turn + (range:read()[1] or 0) * 1e-5 }
end
)";
inline const std::string busy_system = R"(
arena { size = { 3, 3 }, box { at = { 0.8, 0.0, 0.15 }, size = { 0.1, 1.0, 0.3 } } }
robot    "mouse"  { model = "raspimouse", noise = 0.05 }
behavior "keeper" { script = "busy", sets = { fast = { speed = 0.3 } } }
connect("mouse.ir_sensor_out", "keeper.in")
connect("keeper.out", "mouse.target_velocity_in")
)";

struct PastRig : LiveRig {
    PastRig() : LiveRig(busy_system, {{"busy", past_behavior}}) {}

    std::string seek(const Seek& where) {
        const auto done = live->act(where, user);
        return done ? "" : describe(done.error());
    }
    std::string seek(std::int64_t tick, const std::string& branch = "") {
        return seek(Seek{.branch = branch, .tick = tick});
    }
    void act(const Act& act) {
        const auto done = live->act(act, user);
        INFO((done ? "" : describe(done.error())));
        REQUIRE(done);
    }
    void add_second() {
        act(Add{BehaviorEntry{.name = "second", .script = "busy", .path = folder.path("behaviors/busy.lua").string()}});
        act(Activate{"second"});
    }
    void set_speed(double speed) { act(SetParameter{"keeper", "speed", speed}); }
};

}  // namespace nezumi

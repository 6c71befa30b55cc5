// A program that embeds nezumi and ticks by itself stops its robots as `nezumi run` does.
#include <catch2/catch.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings/embed/simulation.hpp"
#include "engine/devices/joystick.hpp"
#include "engine/live/run_loop.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

// A gamepad that says what the test wants.
struct TestGamepad : Gamepad {
    explicit TestGamepad(GamepadState& its_state) : told(its_state) {}
    std::optional<GamepadState> state() override { return told; }
    std::vector<std::string> take_faults() override { return {}; }
    GamepadState& told;
};

// The tutorial's mouse drives towards the wall, and there is a gamepad.
struct Program {
    Program() {
        LiveOptions options = simulated_systems({source_root()});
        options.components["Joystick"]["sim"] = [this](const ComponentEntry& entry, System&) {
            return Expected<std::unique_ptr<Component>>(std::make_unique<Joystick>(
                entry.name, [this](const GamepadSettings&) { return std::make_unique<TestGamepad>(gamepad); }));
        };
        auto loaded = Simulation::load_with(root / "behaviors/systems/stop_at_wall.lua", std::move(options));
        REQUIRE(loaded);
        simulation.emplace(std::move(*loaded));
        REQUIRE(simulation->act(Add{ComponentEntry{.name = "stick", .type = "Joystick"}}));
        REQUIRE(simulation->act(Activate{"stick"}));
        simulation->run(1);
    }
    double speed() const { return simulation->system().find_robot("mouse")->guard().current().vx; }

    GamepadState gamepad;
    std::optional<Simulation> simulation;
};

}  // namespace

TEST_CASE("a gamepad's button stops the robots of a program that ticks by itself", "[embed][safety]") {
    Program program;
    REQUIRE(program.speed() > 0.05);
    program.gamepad.stops = 1;
    program.simulation->tick();
    CHECK(program.simulation->system().is_stopped());
    program.simulation->run(0.5);
    CHECK(program.speed() == 0);
    // Once: whoever lets the robots drive again is not stopped by the same press.
    REQUIRE(program.simulation->act(Rearm{}));
    program.simulation->run(0.5);
    CHECK_FALSE(program.simulation->system().is_stopped());
}

TEST_CASE("a button stops the system if its gamepad was plugged in during the run, and not if it was removed",
          "[embed][safety]") {
    Program program;
    REQUIRE(program.simulation->act(Remove{"stick"}));
    program.gamepad.stops = 1;
    program.simulation->run(0.1);
    CHECK_FALSE(program.simulation->system().is_stopped());
}

TEST_CASE("a program may leave the ticks to the loop of nezumi run", "[embed]") {
    Program program;
    RunLoop loop(program.simulation->running(), {.speed = as_fast_as_possible});
    loop.end_at(3);
    loop.after_tick([&] { program.gamepad.stops = program.simulation->now() >= 2 ? 1 : 0; });
    loop.run();
    CHECK(loop.came_to_end());
    CHECK(program.simulation->now() == Approx(3));
    CHECK(program.simulation->system().is_stopped());
    CHECK(program.speed() == 0);
}

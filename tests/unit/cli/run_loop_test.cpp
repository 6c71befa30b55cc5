// The loop of a run with a real robot, which no pause may leave driving.
#include "bindings/cli/run_loop.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/engine/fake_world.hpp"
#include "tests/unit/engine/try_component.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

// A mouse whose body is none of a world's, driven at 0.1 m/s by a hand on its in-port.
struct RealRun {
    RealRun() {
        SystemSpec spec;
        spec.models["mouse"] = fake_mouse();
        RobotEntry entry;
        entry.name = "mouse";
        entry.model = "mouse";
        entry.backend = "driver";
        spec.entries.emplace_back(entry);
        LiveOptions options;
        options.bodies["driver"] = [this](const RobotEntry&,
                                          const RobotSpec& model) -> Expected<std::unique_ptr<RobotBody>> {
            return std::make_unique<FakeBody>(hull, model, not_simulated);
        };
        options.build.real_time = true;
        auto made = LiveSystem::make(std::move(spec), Project::of("behaviors/systems/any.lua"), std::move(options));
        REQUIRE(made);
        live = std::move(*made);
        live->activate();
        REQUIRE(live->act(Hold{"mouse.velocity_in", Velocity2D{.vx = 0.1}}, {}));
    }
    const Robot& robot() const { return *live->system().find_robot("mouse"); }

    FakeHull hull;
    std::unique_ptr<LiveSystem> live;
};

// Ends the run once this is so.
struct Until final : Attendant {
    Until(RunLoop& its_loop, std::function<bool()> its_condition)
        : loop(its_loop), condition(std::move(its_condition)) {}
    bool serve(Pacer::Clock::time_point) override {
        if (condition()) loop.quit();
        return false;
    }
    RunLoop& loop;
    std::function<bool()> condition;
};

// Runs a loop until then; false when that was not within 20 s.
bool run_until(RunLoop& loop, std::function<bool()> condition) {
    Until until(loop, condition);
    loop.add(until);
    loop.end_at(loop.live().system().now().seconds + 20);
    loop.run();
    return condition();
}

}  // namespace

TEST_CASE("a pause of a real robot stops it, and time goes on", "[cli][hardware]") {
    RealRun run;
    const RunLoop::Options options;
    const auto drives = [&] { return run.hull.speeds.left > 0.05; };
    {
        RunLoop loop(*run.live, options);
        CHECK(loop.is_hardware());
        CHECK(run_until(loop, drives));
    }
    {
        RunLoop loop(*run.live, options);
        loop.pause();
        CHECK(loop.is_paused());
        const auto paused_at = run.live->system().now();
        CHECK(run_until(loop, [&] { return run.hull.speeds == Wheels{}; }));
        CHECK(run.live->system().now().tick > paused_at.tick);
        CHECK(run.live->system().now().seconds > paused_at.seconds);
        CHECK(run.robot().find_out_port("ir")->latched_tick() == run.live->system().now().tick - 1);
    }
    {
        RunLoop loop(*run.live, options);
        loop.pause();
        loop.resume();
        CHECK_FALSE(loop.is_paused());
        CHECK(run_until(loop, drives));
    }
}

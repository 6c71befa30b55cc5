// The systems that are shipped, run from file to wheels: reading, building, sensing, deciding and driving.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/script/script_component.hpp"
#include "engine/system/build_system.hpp"
#include "sim/world.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

Expected<std::unique_ptr<Component>> make_behavior(const BehaviorEntry& entry, const MakerContext& context) {
    auto source = read_source(entry.path);
    if (!source) return Unexpected(source.error());
    ScriptContext script;
    script.seed = context.seed;
    script.tick_rate = context.tick_rate;
    script.budget = headless_budget;
    script.configured = entry.config;
    auto made = ScriptComponent::load(entry.name, std::move(*source), std::move(script));
    if (!made) return Unexpected(made.error());
    return std::unique_ptr<Component>(std::move(*made));
}

// A system that runs, and what it said.
struct Run {
    explicit Run(const std::string& text, const std::string& file = "behaviors/systems/any.lua") {
        const Project project = Project::of(root / file, {root});
        auto read = text.empty() ? read_system_file(root / file, project) : read_system_text(text, file, project);
        if (!read) FAIL(describe(read.error()));
        spec = std::move(*read);
        Makers makers;
        makers.world = sim::make_world;
        makers.behavior = make_behavior;
        auto built = build_system(spec, makers, {.log = [this](const LogLine& line) { log.push_back(line.text); }});
        if (!built) FAIL(describe(built.error()));
        system = std::move(*built);
        activate_all(*system, spec);
    }

    void seconds(double duration) {
        for (auto left = std::lround(duration * spec.rate); left > 0; --left) system->tick();
    }
    Truth truth(std::string_view robot) { return system->world()->truth(system->find_robot(robot)->id()); }

    SystemSpec spec;
    std::vector<std::string> log;
    std::unique_ptr<System> system;
};

}  // namespace

TEST_CASE("the tutorial's mouse drives up to the wall and stops", "[lua][shipped]") {
    Run run("", "behaviors/systems/stop_at_wall.lua");
    run.seconds(2);
    CHECK(run.truth("mouse").velocity.vx == Approx(0.1).epsilon(0.05));
    run.seconds(10);
    const Truth mouse = run.truth("mouse");
    CHECK(std::abs(mouse.velocity.vx) < 0.001);
    CHECK(mouse.pose.position.x > 0.4);
    CHECK(mouse.pose.position.x < 0.7);
    CHECK(std::abs(mouse.pose.position.y) < 0.01);
    CHECK_FALSE(run.system->world()->collided(0));
    CHECK(run.log == std::vector<std::string>{});
}

TEST_CASE("two mice stop in front of each other", "[lua][shipped]") {
    Run run("", "behaviors/systems/two_mice.lua");
    run.seconds(12);
    const double left = run.truth("left_mouse").pose.position.x;
    const double right = run.truth("right_mouse").pose.position.x;
    CHECK(left > -0.4);
    CHECK(right < 0.4);
    CHECK(right - left > 0.1);
    CHECK(std::abs(run.truth("left_mouse").velocity.vx) < 0.001);
    CHECK(std::abs(run.truth("right_mouse").velocity.vx) < 0.001);
}

TEST_CASE("a swarm stays within its walls, and no behaviour fails", "[lua][shipped]") {
    Run run("require 'lib.swarm_arena' { count = 10, side = 4, model = 'swarm_robot' }");
    CHECK(run.spec.rate == 10);
    CHECK(run.spec.seed == 124);
    REQUIRE(run.spec.entries.size() == 20);
    std::vector<Pose2D> start;
    for (int i = 1; i <= 10; ++i) start.push_back(run.truth("robot_" + std::to_string(i)).pose);
    run.seconds(20);
    for (int i = 1; i <= 10; ++i) {
        const Truth robot = run.truth("robot_" + std::to_string(i));
        const Point2D& from = start[static_cast<std::size_t>(i - 1)].position;
        CAPTURE(i);
        CHECK(std::abs(robot.pose.position.x) < 2);
        CHECK(std::abs(robot.pose.position.y) < 2);
        CHECK(std::hypot(robot.pose.position.x - from.x, robot.pose.position.y - from.y) > 0.05);
        CHECK(run.system->find("swarm_" + std::to_string(i))->state() == LifeState::active);
    }
    CHECK(run.log == std::vector<std::string>{});
}

TEST_CASE("a robot from a user's file drives and measures without C++ code", "[lua][shipped]") {
    Run run(R"(
        arena { box { at = { 1.05, 0 }, size = { 0.1, 1, 0.3 } } }
        robot "mine" { model = "tests/unit/lua/my_robot.lua" }
        behavior "c" { script = "robot_controller", config = { speed_x = 0.2, stop_d = 50 } }
        connect("mine.eyes", "c.in")
        connect("c.out", "mine.go"))",
            "any.lua");
    run.seconds(10);
    // Its eye, 0.1 m before the centre, answers 100 - 200 * d: 50 at 0.25 m from the wall's face at 1 m.
    CHECK(run.truth("mine").pose.position.x == Approx(0.65).margin(0.03));
    CHECK(std::abs(run.truth("mine").velocity.vx) < 0.001);
}

// Faults known from other simulators of these robots, tested with ours from the system file to the wheels.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bindings/lua/files/system_file.hpp"
#include "bindings/lua/script/behavior_maker.hpp"
#include "engine/trace/trace_hash.hpp"
#include "sim/world.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

// An ACTIVE system made from this text (or a shipped file), without clock and window.
struct Run {
    explicit Run(const std::string& text, const std::string& file = "behaviors/systems/any.lua") {
        const Project project = Project::of(::root / file, {::root});
        auto read = text.empty() ? read_system_file(::root / file, project) : read_system_text(text, file, project);
        if (!read) FAIL(describe(read.error()));
        spec = std::move(*read);
        start(project);
    }
    Run(SystemSpec given, double step) : spec(std::move(given)) {
        spec.physics_step = step;
        start(Project::of(::root / spec.file, {::root}));
    }

    void start(const Project& project) {
        const BehaviorSettings settings{.project = project, .budget = headless_budget};
        Makers makers;
        makers.world = sim::make_world;
        makers.behavior = [&](const BehaviorEntry& e, const MakerContext& c) { return make_behavior(e, c, settings); };
        auto built = build_system(spec, makers, {.log = [this](const LogLine& line) { log.push_back(line.text); }});
        if (!built) FAIL(describe(built.error()));
        system = std::move(*built);
        system->observe(trace);
        activate_all(*system, spec);
    }

    void seconds(double duration) {
        for (auto left = std::lround(duration * spec.rate); left > 0; --left) system->tick();
    }
    // Sends this velocity in every tick.
    void drive(double duration, const Velocity2D& velocity) {
        for (auto left = std::lround(duration * spec.rate); left > 0; --left) {
            send("mouse.target_velocity_in", velocity);
            system->tick();
        }
    }
    void send(std::string_view port, const Value& value) {
        static_cast<InPortBase&>(**system->port(port)).inject(value);
    }
    template <class T>
    T value(std::string_view port) {
        return (*system->port(port))->value().template get<T>();
    }
    Truth truth(std::string_view robot = "mouse") { return system->world()->truth(system->find_robot(robot)->id()); }

    SystemSpec spec;
    std::vector<std::string> log;
    TraceHash trace;
    std::unique_ptr<System> system;
};

const std::string mouse = "robot 'mouse' { model = 'raspimouse' }\n";

}  // namespace

TEST_CASE("without an obstacle the infrared sensors give 0 and 0.60 m, and never less", "[sim][fault]") {
    Run run(mouse);
    run.seconds(0.1);
    CHECK(run.value<std::vector<std::int16_t>>("mouse.ir_sensor_out") == std::vector<std::int16_t>{0, 0, 0, 0});
    CHECK(run.value<std::vector<double>>("mouse.ir_sensor_metre_out") == std::vector<double>{0.6, 0.6, 0.6, 0.6});
    // Towards a wall and away from it again, beyond the end of the table.
    Run wall("arena { box { at = { 0.75, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\n" + mouse);
    std::int16_t most = 0;
    const auto look = [&] {
        for (const std::int16_t value : wall.value<std::vector<std::int16_t>>("mouse.ir_sensor_out")) {
            REQUIRE(value >= 0);
            REQUIRE(value <= 4095);
            most = std::max(most, value);
        }
        for (const double value : wall.value<std::vector<double>>("mouse.ir_sensor_metre_out")) {
            REQUIRE(value >= 0);
            REQUIRE(value <= 0.6);
        }
    };
    for (int tick = 0; tick < 250; ++tick) wall.drive(0.01, {.vx = 0.3}), look();
    CHECK(most > 1000);
    for (int tick = 0; tick < 500; ++tick) wall.drive(0.01, {.vx = -0.3}), look();
    CHECK(wall.value<std::vector<std::int16_t>>("mouse.ir_sensor_out")[0] == 0);
}

TEST_CASE("a mouse driven at 1.5 m/s with the limit lifted does not flip over", "[sim][fault]") {
    Run run("robot 'mouse' { model = 'raspimouse', limits = { speed = 1.5, acceleration = 20 } }");
    double tilt = 0;
    for (const double speed : {1.2, 1.5, -1.5, 0.0}) {
        for (int tick = 0; tick < 100; ++tick) {
            run.drive(0.01, {.vx = speed});
            tilt = std::max(tilt, run.truth().tilt);
        }
        CHECK(run.truth().velocity.vx == Approx(speed).epsilon(0.01).margin(1e-3));
    }
    CHECK(tilt < 0.2);
    CHECK(run.log.empty());
}

TEST_CASE("a mouse stands on its wheels and drives, for any step of the physics", "[sim][fault]") {
    for (const char* step : {"0.001", "0.005", "0.01"}) {
        Run run("physics { step = " + std::string(step) + " }\n" + mouse);
        run.seconds(1);
        CHECK(std::abs(run.truth().height) < 1e-5);
        run.drive(2, {.vx = 0.1});
        CHECK(run.truth().pose.position.x == Approx(0.2).epsilon(0.03));
    }
}

TEST_CASE("the velocity that a mouse publishes is in its own frame", "[sim][fault]") {
    for (const char* heading : {"0", "1.5707963", "3.1415926", "-2"}) {
        Run run("robot 'mouse' { model = 'raspimouse', pose = { x = 1, y = -1, heading = " + std::string(heading) +
                " } }");
        run.drive(1, {.vx = 0.2, .va = 0.5});
        const auto velocity = run.value<Velocity2D>("mouse.current_velocity_out");
        CHECK(velocity.vx == Approx(0.2).epsilon(0.01));
        CHECK(velocity.vy == 0);
        CHECK(velocity.va == Approx(0.5).epsilon(0.01));
        CHECK(run.truth().velocity.vx == Approx(0.2).epsilon(0.01));
    }
}

TEST_CASE("odometry follows the wheels, not the truth", "[sim][fault]") {
    // It starts at zero at any pose, and agrees with the truth while the wheels grip.
    Run free("robot 'mouse' { model = 'raspimouse', pose = { x = 1, y = 2, heading = 1 } }");
    free.seconds(0.1);
    CHECK(free.value<Pose2D>("mouse.current_pose_out") == Pose2D{});
    free.drive(3, {.vx = 0.2, .va = 0.5});
    const Pose2D odometry = free.value<Pose2D>("mouse.current_pose_out");
    const Pose2D truth = free.truth().pose;
    const double x = truth.position.x - 1, y = truth.position.y - 2;
    CHECK(odometry.position.x == Approx(x * std::cos(1) + y * std::sin(1)).margin(0.01));
    CHECK(odometry.position.y == Approx(y * std::cos(1) - x * std::sin(1)).margin(0.01));
    CHECK(odometry.heading == Approx(truth.heading - 1).margin(0.02));
    // Wheels that spin at a wall, and a teleport, make the two different.
    Run wall("arena { box { at = { 0.2, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\n" + mouse);
    wall.drive(5, {.vx = 0.2});
    CHECK(wall.value<Pose2D>("mouse.current_pose_out").position.x == Approx(0.2 * 5).epsilon(0.03));
    CHECK(wall.truth().pose.position.x < 0.11);
    const Pose2D before = free.value<Pose2D>("mouse.current_pose_out");
    free.drive(1, {});
    REQUIRE(free.system->world()->teleport(0, {{-1, -1}, 0}));
    free.seconds(0.1);
    CHECK(std::hypot(free.value<Pose2D>("mouse.current_pose_out").position.x - before.position.x,
                     free.value<Pose2D>("mouse.current_pose_out").position.y - before.position.y) < 0.05);
}

TEST_CASE("a pose update sets the odometry", "[sim][fault]") {
    Run run(mouse);
    run.drive(1, {.vx = 0.2});
    run.drive(1, {});
    run.send("mouse.pose_update", Pose2D{{3, 4}, M_PI / 2});
    run.drive(1, {.vx = 0.2});
    const auto pose = run.value<Pose2D>("mouse.current_pose_out");
    CHECK(pose.position.x == Approx(3).margin(0.01));
    CHECK(pose.position.y == Approx(4.19).margin(0.02));
    CHECK(run.truth().pose.position.x == Approx(0.38).margin(0.03));  // the truth is not moved
}

TEST_CASE("a command ends with its controller", "[sim][fault][safety]") {
    const std::string driven = mouse +
                               "behavior 'controller' { script = 'robot_controller', config = { speed_x = 0.3 } }\n"
                               "connect('controller.out', 'mouse.target_velocity_in')";
    const auto stops_within = [](Run& run, double seconds) {
        run.seconds(seconds);
        return std::abs(run.truth().velocity.vx) < 1e-3;
    };
    Run silent(driven);
    silent.seconds(1);
    CHECK(silent.truth().velocity.vx == Approx(0.3).epsilon(0.02));
    (*silent.system->port("controller.out"))->drop();
    silent.seconds(0.45);
    CHECK(silent.truth().velocity.vx == Approx(0.3).epsilon(0.02));
    CHECK(stops_within(silent, 0.3));

    Run removed(driven);
    removed.seconds(1);
    REQUIRE(removed.system->remove("controller"));
    CHECK(stops_within(removed, 0.25));

    Run disconnected(driven);
    disconnected.seconds(1);
    REQUIRE(disconnected.system->disconnect("controller.out", "mouse.target_velocity_in"));
    CHECK(stops_within(disconnected, 0.25));

    Run deactivated(driven);
    deactivated.seconds(1);
    REQUIRE(deactivated.system->find("controller")->deactivate(deactivated.system->now()));
    CHECK(stops_within(deactivated, 0.25));
}

TEST_CASE("many robots, worlds and systems live in one process", "[sim][fault]") {
    const std::string classroom = R"(
for i = 1, 12 do
  local mouse, controller = "mouse" .. i, "controller" .. i
  robot(mouse) { model = "raspimouse", pose = { x = i % 4, y = i // 4, heading = i } }
  behavior(controller) { script = "robot_controller", config = { speed_x = 0.01 * i } }
  connect(controller .. ".out", mouse .. ".target_velocity_in")
end)";
    Run alone(classroom);
    alone.seconds(3);
    for (int i = 1; i <= 12; ++i) {
        CHECK(alone.truth("mouse" + std::to_string(i)).velocity.vx == Approx(0.01 * i).epsilon(0.02));
    }
    Run first(classroom), second(mouse);
    for (int tick = 0; tick < 300; ++tick) {
        first.system->tick();
        second.drive(0.01, {.vx = 0.3});
    }
    CHECK(first.trace.value() == alone.trace.value());
    CHECK(second.truth().velocity.vx == Approx(0.3).epsilon(0.02));
}

TEST_CASE("simulated time does not run slow: no step comes from a rate", "[sim][fault]") {
    for (const char* rate : {"10", "20", "40", "100", "200"}) {
        INFO("rate " << rate);
        Run run("rate(" + std::string(rate) + ")\n" + mouse);
        run.drive(10, {.vx = 0.2});
        CHECK(run.system->now().seconds == 10);
        // Half the time for acceleration, and at most one tick until the first command arrives.
        const double expected = 0.2 * (10 - 0.05);
        CHECK(run.truth().pose.position.x == Approx(expected).margin(0.2 / run.spec.rate + 0.004));
    }
}

TEST_CASE("the tutorial's run at the default step of 5 ms agrees with 1 ms within 1 %", "[sim][determinism]") {
    Run coarse("", "behaviors/systems/stop_at_wall.lua");
    Run fine(coarse.spec, 0.001);
    REQUIRE(coarse.spec.physics_step == 0.005);
    for (int tenth = 1; tenth <= 100; ++tenth) {
        coarse.seconds(0.1);
        fine.seconds(0.1);
        const Pose2D a = coarse.truth().pose, b = fine.truth().pose;
        const double driven = std::max(b.position.x, 0.01);
        REQUIRE(std::hypot(a.position.x - b.position.x, a.position.y - b.position.y) < 0.01 * driven);
        REQUIRE(std::abs(a.heading - b.heading) < 0.001);
    }
    CHECK(std::abs(coarse.truth().velocity.vx) < 1e-3);
    CHECK(std::abs(fine.truth().velocity.vx) < 1e-3);
}

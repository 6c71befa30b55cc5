// `--hw --twin`: a simulated robot beside the real one, which never has a say in what that does.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bindings/cli/run/hardware.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "engine/live/twins.hpp"
#include "engine/system/build_system.hpp"
#include "sim/world.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::cli;

namespace {

// What stands for a real mouse: wheels that turn as told, the left one at so much of its speed.
struct Wheelwork {
    double left_share = 1;
    bool is_read = true;
    Wheels told{}, metres{};
    std::vector<std::string> calls{};
};

class RealBody final : public RobotBody {
public:
    RealBody(Wheelwork& work, const RobotSpec& spec) : work_(work), spec_(spec), readings_(spec.sensors.size()) {}
    RobotId id() const override { return not_simulated; }
    WheelReading read_wheels(const Time& now, double period) override {
        work_.metres.left += work_.told.left * work_.left_share * period;
        work_.metres.right += work_.told.right * period;
        const double pulse = 2 * std::numbers::pi * spec_.drive.radius / spec_.drive.encoder_pulses();
        return {.is_there = work_.is_read,
                .tm = now.seconds,
                .pulses = {std::llround(work_.metres.left / pulse), std::llround(work_.metres.right / pulse)},
                .speeds = work_.told};
    }
    std::span<const SensorReading> read_sensors(const Time& now, double /*period*/) override {
        for (SensorReading& reading : readings_) reading = {.is_there = true, .tm = now.seconds};
        return readings_;
    }
    void set_wheel_speeds(Wheels speeds) override {
        work_.told = speeds;
        work_.calls.push_back(fmt::format("wheels {} {}", speeds.left, speeds.right));
    }
    void coast() override {
        work_.told = {};
        work_.calls.emplace_back("coast");
    }
    void set_motor_power(bool on) override { work_.calls.push_back(fmt::format("power {}", on)); }
    void aim_servo(std::size_t, double, double) override { work_.calls.emplace_back("servo"); }

private:
    Wheelwork& work_;
    const RobotSpec& spec_;
    std::vector<SensorReading> readings_;
};

const std::string one_mouse = "robot 'mouse' { model = 'raspimouse', pose = { x = 0.2, y = 0.1, heading = 1 } }\n";

// A system file's mouse is real, and may have a twin.
struct Pair {
    explicit Pair(const std::string& text, bool with_twin = true) {
        const auto file = scratch.write("system.lua", text);
        auto read = read_system_file(file, Project::of(file, {source_root()}), {});
        REQUIRE(read);
        spec = std::move(*read);
        REQUIRE(choose_drivers(spec, {"mouse"}, {}));
        if (with_twin) REQUIRE(add_twins(spec));
        const Makers makers{
            .world = sim::make_world,
            .bodies = {{"raspimouse", [this](const RobotEntry&,
                                             const RobotSpec& its) { return std::make_unique<RealBody>(work, its); }}},
            .behavior = nullptr,
            .components = {}};
        auto built = build_system(spec, makers, {});
        if (!built) FAIL(describe(built.error()));
        system = std::move(*built);
        activate_all(*system, spec);
    }
    void drive(double seconds, const Velocity2D& velocity) {
        for (int i = 0; i < std::lround(seconds * 100); ++i) {
            static_cast<InPort<Velocity2D>&>(*system->find("mouse")->find_in_port("target_velocity_in"))
                .inject(velocity);
            system->tick();
        }
    }
    Robot& twin() { return static_cast<Robot&>(*system->find("mouse_twin")); }
    const OutPort<Pose2D>& error_port() { return static_cast<const OutPort<Pose2D>&>(*twin().find_out_port("error")); }
    Pose2D error() { return error_port().read(); }
    Pose2D truth() { return system->world()->truth(twin().id()).pose; }

    Scratch scratch;
    Wheelwork work;
    SystemSpec spec;
    std::unique_ptr<System> system;
};

std::string refused_twin(const std::string& text) {
    const Scratch scratch;
    const auto file = scratch.write("system.lua", text);
    auto spec = read_system_file(file, Project::of(file, {source_root()}), {});
    REQUIRE(spec);
    for (Entry& entry : spec->entries) {
        auto* robot = std::get_if<RobotEntry>(&entry);
        if (robot != nullptr && robot->backend.empty()) robot->backend = "raspimouse";
    }
    spec->file = "system.lua";
    const auto added = add_twins(*spec);
    return added ? "" : added.error().message;
}

}  // namespace

TEST_CASE("a twin starts at the pose in the file, gets the real robot's commands, and the error stays small",
          "[cli][hw][twin]") {
    Pair pair(one_mouse);
    CHECK(pair.truth().position.x == Approx(0.2).margin(1e-4));
    pair.drive(2, {.vx = 0.15, .va = 0.5});
    pair.drive(1, {});
    const Pose2D truth = pair.truth();
    CHECK(std::hypot(truth.position.x - 0.2, truth.position.y - 0.1) > 0.2);
    CHECK(std::abs(pair.error().position.x) < 0.003);
    CHECK(std::abs(pair.error().position.y) < 0.003);
    CHECK(std::abs(pair.error().heading) < 0.02);
}

TEST_CASE("the error is the real robot's pose as its twin sees it: ahead and to the left are positive",
          "[cli][hw][twin]") {
    Pair pair(
        "arena { box { at = { 0.3, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\nrobot 'mouse' { model = 'raspimouse' }\n");
    pair.drive(4, {.vx = 0.15});  // the box is in the twin's world only
    pair.drive(1, {});
    CHECK(pair.work.metres.left > 0.5);
    CHECK(pair.truth().position.x < 0.22);
    CHECK(pair.error().position.x == Approx(pair.work.metres.left - pair.truth().position.x).margin(0.01));

    Pair slips(one_mouse);
    slips.work.left_share = 0.9;  // the real one bends to the left
    slips.drive(3, {.vx = 0.15});
    slips.drive(1, {});
    CHECK(slips.error().position.x < -0.01);
    CHECK(slips.error().position.y > 0.01);
    CHECK(slips.error().heading == Approx((slips.work.metres.right - slips.work.metres.left) / 0.0925).margin(0.03));
}

TEST_CASE("a pose that the odometry is given, and an activation of the twin, begin the error at zero",
          "[cli][hw][twin]") {
    Pair pair(one_mouse);
    pair.work.left_share = 0.8;
    pair.drive(2, {.vx = 0.15});
    REQUIRE(std::abs(pair.error().heading) > 0.1);
    static_cast<InPort<Pose2D>&>(*pair.system->find("mouse")->find_in_port("pose_update"))
        .inject(Pose2D{.position = {7, 8}, .heading = 2});
    pair.drive(0.02, {});
    CHECK(std::abs(pair.error().position.x) < 0.01);
    CHECK(std::abs(pair.error().heading) < 0.05);
    pair.drive(1, {.vx = 0.15});
    REQUIRE(std::abs(pair.error().heading) > 0.1);
    REQUIRE(pair.twin().deactivate(pair.system->now()));
    pair.drive(0.5, {});
    REQUIRE(pair.twin().activate(pair.system->now()));
    pair.drive(0.02, {});
    CHECK(std::abs(pair.error().position.x) < 0.002);
    CHECK(std::abs(pair.error().heading) < 0.02);
}

TEST_CASE("while the real robot's odometry is silent so is the error", "[cli][hw][twin]") {
    Pair pair(one_mouse);
    pair.drive(0.5, {});
    const double before = pair.error_port().tm();
    CHECK(before > 0.4);
    pair.work.is_read = false;
    pair.drive(0.5, {});
    CHECK(pair.error_port().tm() == before);
}

TEST_CASE("a twin never changes the commands that the real robot gets", "[cli][hw][twin][safety]") {
    const std::string text =
        "arena { box { at = { 0.3, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\nrobot 'mouse' { model = 'raspimouse' }\n";
    const auto calls = [&](bool with_twin) {
        Pair pair(text, with_twin);
        World& world = *pair.system->world();
        const auto do_to_twin = [&](const std::function<void(Robot&)>& action) {
            if (with_twin) action(pair.twin());
        };
        pair.drive(3, {.vx = 0.2});  // against the box
        do_to_twin([&](Robot& twin) { CHECK(world.collided(twin.id())); });
        do_to_twin([&](Robot& twin) { world.disturb(twin.id(), {.vx = -0.3, .vy = 0.1, .va = 1}); });
        pair.drive(0.5, {.vx = 0.2, .va = 1});
        pair.system->emergency_stop();
        pair.drive(1, {.vx = 0.2});
        CHECK(pair.system->rearm());  // although the twin is pushed around
        pair.drive(0.5, {.vx = -0.1});
        do_to_twin([&](Robot& twin) { CHECK(world.teleport(twin.id(), {.position = {-3, 0}, .heading = 0})); });
        pair.drive(0.5, {.vx = -0.1});
        do_to_twin([&](Robot& twin) { CHECK(twin.deactivate(pair.system->now())); });
        pair.drive(0.5, {.vx = 0.1});
        if (with_twin) CHECK(pair.system->remove("mouse_twin"));
        pair.drive(0.5, {.vx = 0.1});
        pair.drive(1, {});
        return pair.work.calls;
    };
    const auto without = calls(false);
    CHECK(without.size() > 700);
    CHECK(calls(true) == without);
}

TEST_CASE("a twin stands and is silent when the real robot is gone", "[cli][hw][twin]") {
    Pair pair(one_mouse);
    pair.drive(1, {.vx = 0.15});
    REQUIRE(pair.system->remove("mouse"));
    for (int i = 0; i < 50; ++i) pair.system->tick();
    const double before = pair.error_port().tm();
    for (int i = 0; i < 50; ++i) pair.system->tick();
    CHECK(pair.error_port().tm() == before);
    CHECK(std::abs(pair.system->world()->truth(pair.twin().id()).velocity.vx) < 0.001);
}

TEST_CASE("a twin has the sensors of its model, and no in-port that could command it", "[cli][hw][twin]") {
    Pair pair(
        "arena { box { at = { 0.2, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\nrobot 'mouse' { model = 'raspimouse' }\n");
    pair.drive(0.1, {});
    CHECK(pair.twin().in_ports().empty());
    const auto* ir = static_cast<const OutPort<std::vector<std::int16_t>>*>(pair.twin().find_out_port("ir_sensor_out"));
    REQUIRE(ir != nullptr);
    CHECK(ir->read()[0] > 15);  // the box of the map
}

TEST_CASE("twins that can't be are refused", "[cli][hw][twin]") {
    CHECK(refused_twin("robot 'mouse' { model = 'raspimouse', backend = 'sim' }\n") ==
          "system.lua has no real robot that could have a twin");
    const std::string taken = one_mouse + "robot 'mouse_twin' { model = 'raspimouse', backend = 'sim' }\n";
    CHECK(refused_twin(taken) == "the twin of 'mouse' has the name 'mouse_twin': give this component another name");
    const Scratch scratch;
    const auto system = scratch.write("system.lua", taken);
    auto spec = read_system_file(system, Project::of(system, {source_root()}), {});
    REQUIRE(spec);
    LiveOptions live;
    use_hardware(live, {.robots = {}, .twins = true}, {});
    CHECK(describe(live.prepare(*spec).error()) ==
          fmt::format("{}:2: --twin: the twin of 'mouse' has the name 'mouse_twin': give this component another name",
                      system.string()));
    const std::string file = "behaviors/systems/stop_at_wall.lua";
    const Outcome without_robot = run_nezumi({"run", file, "--twin"});
    CHECK(without_robot.status == 2);
    CHECK(without_robot.error == "nezumi: --twin is for real robots: give --hw as well\n");
    const Outcome threads = run_nezumi({"run", file, "--hw", "--twin", "--threads", "2"});
    CHECK(threads.status == 2);
    CHECK(threads.error == "nezumi: --twin: the real robot and its twin share a thread: leave out --threads\n");
}

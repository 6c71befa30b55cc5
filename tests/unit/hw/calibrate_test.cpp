// Guided calibrations of robots that differ from their model.
#include "hw/calibrate/odometry.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "bindings/lua/files/robot_file.hpp"
#include "hw/calibrate/guided_moves.hpp"
#include "hw/calibrate/ranges.hpp"
#include "sim/world.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

constexpr double step = 0.005;  // [s] of physics
constexpr int steps = 2;        // in a tick

// A robot in its own world that differs slightly from its driver's model, as real robots do.
class TrueRobot final : public RobotBody {
public:
    TrueRobot(const RobotSpec& believed, RobotSpec truth, const ArenaSpec& arena)
        : believed_(believed), truth_(std::move(truth)) {
        world_ = std::move(*sim::make_world(arena, {.step = step, .seed = 3}, nullptr));
        body_ = std::move(*world_->add_robot("true", truth_, {}));
    }

    RobotId id() const override { return not_simulated; }
    Pose2D pose() const { return world_->truth(body_->id()).pose; }
    WheelReading read_wheels(const Time& now, double period) override {
        world_->step(steps);
        return body_->read_wheels(now, period);
    }
    std::span<const SensorReading> read_sensors(const Time& now, double period) override {
        return body_->read_sensors(now, period);
    }
    std::span<const double> sensor_values(std::size_t index) const override { return body_->sensor_values(index); }
    // The driver converts a speed to a motor rate with the wheel radius of its model.
    void set_wheel_speeds(Wheels speeds) override {
        const DriveSpec &believed = believed_.drive, &truth = truth_.drive;
        body_->set_wheel_speeds({.left = speeds.left * truth.radius_of_left() / believed.radius_of_left(),
                                 .right = speeds.right * truth.radius_of_right() / believed.radius_of_right()});
    }
    void coast() override { body_->coast(); }
    void aim_servo(std::size_t /*index*/, double /*angle*/, double /*speed*/) override {}

private:
    const RobotSpec& believed_;
    RobotSpec truth_;
    std::unique_ptr<World> world_;
    std::unique_ptr<RobotBody> body_;
};

RobotSpec model() {
    const std::string file = source_root() + "/engine/robots/raspimouse.lua";
    return *read_robot_file(file, Project::of(file));
}

// A robot with the model `believed` and the properties `truth`.
struct Mistaken {
    Mistaken(RobotSpec believed, const RobotSpec& truth, const ArenaSpec& arena = {}) {
        SystemSpec spec;
        RobotEntry entry;
        entry.name = "mouse";
        entry.model = "model";
        entry.backend = "true";
        spec.entries.emplace_back(entry);
        spec.models.emplace("model", std::move(believed));
        Makers makers;
        makers.bodies["true"] = [&](const RobotEntry&, const RobotSpec& its) -> Expected<std::unique_ptr<RobotBody>> {
            auto made = std::make_unique<TrueRobot>(its, truth, arena);
            body = made.get();
            return made;
        };
        auto made = GuidedRobot::make(std::move(spec), "mouse", makers, {.real_time = false});
        REQUIRE(made);
        robot = std::move(*made);
    }
    // Measures like a person with a tape: to a millimetre, from the robot's start.
    Point2D measured_from(const Pose2D& start) const {
        const Pose2D now = body->pose();
        const double dx = now.position.x - start.position.x, dy = now.position.y - start.position.y;
        const double c = std::cos(start.heading), s = std::sin(start.heading);
        const auto read = [](double metres) { return std::round(metres * 1000) / 1000; };
        return {read(c * dx + s * dy), read(c * dy - s * dx)};
    }

    TrueRobot* body = nullptr;
    std::unique_ptr<GuidedRobot> robot;
};

// The odometry error [m] after a course that was not used for the calibration.
double odometry_error(const RobotSpec& believed, const RobotSpec& truth) {
    Mistaken mouse(believed, truth);
    for (const auto& [distance, angle] :
         {std::pair{0.8, 1.2}, {0.5, -2.0}, {0.7, 2.5}, {0.6, -0.7}, {0.4, std::numbers::pi}}) {
        REQUIRE(go(*mouse.robot, distance, {}));
        REQUIRE(turn(*mouse.robot, angle, {}));
    }
    mouse.robot->rest();
    const Pose2D said = mouse.robot->robot().odometry().pose(), is = mouse.body->pose();
    return std::hypot(said.position.x - is.position.x, said.position.y - is.position.y);
}

// A mouse with noisy light sensors that are weaker than the model's, each by a different factor.
RobotSpec with_weak_sensors() {
    RobotSpec truth = model();
    double weakness = 0.55;
    for (SensorSpec& sensor : truth.sensors) {
        if (sensor.kind != SensorSpec::Kind::range) continue;
        std::vector<ResponseTable::Point> points;
        for (double d = 0.01; d < 0.32; d += 0.01) points.push_back({d, weakness * sensor.response(d)});
        sensor.response = *sensor.response.with_points(points, sensor.range);
        sensor.noise = 2;
        weakness += 0.07;
    }
    return truth;
}

}  // namespace

TEST_CASE("calibrated odometry has less than a fifth of the model's error", "[hw][calibration]") {
    RobotSpec truth = model();
    truth.drive.track = 0.0957;
    truth.drive.left_radius = 0.0243;
    truth.drive.right_radius = 0.0239;
    RobotSpec calibrated = model();
    {
        Mistaken mouse(model(), truth);
        Pose2D start;
        const auto fit = calibrate_odometry(
            *mouse.robot, {},
            {.place =
                 [&](const std::string&) {
                     start = mouse.body->pose();
                     return Expected<void>();
                 },
             .measure = [&](const std::string&) { return Expected<Point2D>(mouse.measured_from(start)); }});
        REQUIRE(fit);
        REQUIRE(
            apply({.robot = "mouse", .model = "", .serial = "", .odometry = fit->wheels, .ranges = {}}, calibrated));
    }
    const double before = odometry_error(model(), truth), after = odometry_error(calibrated, truth);
    CHECK(before > 0.02);
    CHECK(after < before / 5);
    WARN("odometry off by " << before * 1e3 << " mm, calibrated " << after * 1e3 << " mm");
}

TEST_CASE("calibrated distance sensors have less than a fifth of the model's error", "[hw][calibration]") {
    const RobotSpec truth = with_weak_sensors();
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.105, 0, 0.15}, .size = {0.1, 2.0, 0.3}});
    Mistaken mouse(model(), truth, arena);
    const auto ranges = calibrate_ranges(*mouse.robot, {.wall = 0.055});
    REQUIRE(ranges);
    REQUIRE(ranges->size() == 4);
    RobotSpec calibrated = model();
    REQUIRE(apply({.robot = "mouse", .model = "", .serial = "", .odometry = {}, .ranges = *ranges}, calibrated));
    const RobotSpec uncalibrated = model();
    for (std::size_t i = 0; i < truth.sensors.size(); ++i) {
        if (truth.sensors[i].kind != SensorSpec::Kind::range) continue;
        double before = 0, after = 0;
        for (double d = 0.02; d < 0.3; d += 0.01) {
            const double is = truth.sensors[i].response(d);
            before += std::abs(uncalibrated.sensors[i].response(d) - is);
            after += std::abs(calibrated.sensors[i].response(d) - is);
        }
        CAPTURE(truth.sensors[i].name, before, after);
        CHECK(after < before / 5);
    }
}

TEST_CASE("an interrupted calibration leaves the robot standing", "[hw][calibration][safety]") {
    Mistaken mouse(model(), model());
    volatile std::sig_atomic_t end = 0;
    SystemSpec spec = mouse.robot->spec();
    Makers makers;
    TrueRobot* body = nullptr;
    makers.bodies["true"] = [&](const RobotEntry&, const RobotSpec& its) -> Expected<std::unique_ptr<RobotBody>> {
        auto made = std::make_unique<TrueRobot>(its, model(), ArenaSpec{});
        body = made.get();
        return made;
    };
    auto guided = GuidedRobot::make(spec, "mouse", makers, {.real_time = false, .end = &end});
    REQUIRE(guided);
    int ticks = 0;
    const auto gone = go(**guided, 1, {}, [&] { end = ++ticks > 50 ? 1 : 0; });
    REQUIRE_FALSE(gone);
    CHECK(gone.error().message == "interrupted: the robot has stopped");
    CHECK((*guided)->robot().stands());
    CHECK(body->pose().position.x < 0.3);
}

TEST_CASE("a calibration in simulation writes nothing", "[hw][calibration]") {
    const Scratch scratch;
    scratch.write("system.lua", "robot 'mouse' { model = 'raspimouse' }");
    const Outcome outcome =
        run_nezumi({"calibrate", "odometry", "system.lua", "--sim", "--side", "0.2"}, scratch.path("").string());
    CHECK(outcome.status == 0);
    CHECK(outcome.out.starts_with("track 0.09"));
    CHECK(outcome.out.ends_with("nothing is written, because this was a simulation\n"));
    CHECK_FALSE(std::filesystem::exists(scratch.path("mouse.calibration.lua")));
}

TEST_CASE("in simulation the distance of the wall is that ahead, also with sensors to the side and to the rear",
          "[hw][calibration]") {
    const Scratch scratch;
    scratch.write(
        "seeing.lua",
        "local function at(x, y, yaw)\n"
        "  return { kind = 'range', at = { x, y, 0.02 }, yaw = yaw, range = 1, table = { { 0, 800 }, { 1, 0 } } }\n"
        "end\n"
        "return robot_model { base = 'raspimouse',\n"
        "  sensors = { rear = at(-0.05, 0, math.pi), side = at(0, 0.05, math.pi / 2) } }");
    scratch.write("system.lua",
                  "arena { size = { 3, 3 }, wall { from = { 0.3, -1 }, to = { 0.3, 1 } },\n"
                  "  wall { from = { -1, 0.2 }, to = { 0.1, 0.2 } } }\n"
                  "robot 'mouse' { model = 'seeing' }");
    const Outcome outcome = run_nezumi({"calibrate", "ir", "system.lua", "--sim"}, scratch.path("").string());
    CHECK(outcome.status == 0);
    // 500 and more only within 0.03 m.
    const std::string begin = "left_front: 0.0";
    REQUIRE(outcome.out.starts_with(begin));
    CHECK(std::stoi(outcome.out.substr(outcome.out.find(" m ") + 3)) > 500);
}

TEST_CASE("a robot that can't be calibrated is refused in one line", "[hw][calibration]") {
    const Scratch scratch;
    const std::string folder = scratch.path("").string();
    scratch.write("two.lua", "robot 'a' { model = 'raspimouse' } robot 'b' { model = 'raspimouse', pose = { x = 1 } }");
    scratch.write("none.lua", "arena {}");
    const auto said = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "calibrate");
        const Outcome outcome = run_nezumi(std::move(words), folder);
        CHECK(outcome.status == 2);
        return outcome.error;
    };
    CHECK(said({"odometry", "two.lua", "--yes"}) ==
          "nezumi: two.lua has several robots: choose one by --robot, of a, b\n");
    CHECK(said({"ir", "two.lua", "--yes", "--robot", "c"}) == "nezumi: there is no robot 'c' in two.lua\n");
    CHECK(said({"ir", "none.lua", "--yes"}) == "nezumi: none.lua has no robot\n");
    CHECK(said({"odometry", "two.lua", "--robot", "a"}) ==
          "nezumi: a person must stand beside the robot: run this command in a terminal, or add --yes\n");
    CHECK(said({"odometry", "two.lua", "--robot", "a", "--yes", "--dev-root", folder}).find("rtmotoren0") !=
          std::string::npos);
}

TEST_CASE("a real robot does not move with a damaged calibration or that of another robot",
          "[hw][calibration][safety]") {
    const Scratch scratch;
    const std::string folder = scratch.path("").string();
    scratch.write("system.lua", "robot 'mouse' { model = 'raspimouse' }");
    for (const char* node : {"rtmotoren0", "rtmotor_raw_l0", "rtmotor_raw_r0"}) scratch.write(node, "untouched");
    const auto said = [&](const char* calibration) {
        scratch.write("mouse.calibration.lua", calibration);
        const Outcome outcome = run_nezumi({"run", "system.lua", "--hw", "--headless", "--dev-root", folder}, folder);
        CHECK(outcome.status == 2);
        std::ifstream node(scratch.path("rtmotoren0"));
        std::string text;
        std::getline(node, text);
        CHECK(text == "untouched");
        return outcome.error;
    };
    CHECK(said("calibration { robot = 'mouse', model = 'raspimouse',\n odometry = { track =") ==
          "mouse.calibration.lua:2: unexpected symbol near <eof>\n");
    CHECK(
        said("calibration { robot = 'mickey', model = 'raspimouse' }") ==
        "mouse.calibration.lua: is the calibration of another robot: its name is 'mickey', not 'mouse'. Calibrate this "
        "robot, or move the file away\n");
}

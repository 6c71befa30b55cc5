// Robot files: the shipped robots and a user's own.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <tuple>

#include "engine/robot/robot.hpp"
#include "tests/unit/lua/robot_reader.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::robot_files;

TEST_CASE("the description of the Raspberry Pi Mouse has the documented values", "[lua][robot_file]") {
    const RobotSpec mouse = shipped("raspimouse.lua");
    CHECK(mouse.model == "raspimouse");
    CHECK(mouse.mass == 0.72);
    CHECK(mouse.body.shape == BodySpec::Shape::box);
    CHECK(mouse.body.size == Point3D{0.10, 0.08, 0.06});
    CHECK(mouse.drive.radius * 2 == 0.048);
    CHECK(mouse.drive.track == 0.0925);
    CHECK(mouse.drive.pulses_per_turn == 400);
    CHECK(mouse.drive.limits == Limits{0.5, 6, 2.0, 12});
    CHECK(mouse.drive.hardware_limits == Limits{0.2, 2, 0.52, 4});
    CHECK_FALSE(mouse.drive.coasts_until_commanded);
    CHECK(mouse.place.file == "engine/robots/raspimouse.lua");
}

TEST_CASE("the mouse's four infrared sensors have their positions, right first", "[lua][robot_file]") {
    const RobotSpec mouse = shipped("raspimouse.lua");
    const auto check = [&](std::string_view name, double x, double y, double degrees) {
        const SensorSpec& sensor = sensor_of(mouse, name);
        CAPTURE(name);
        CHECK(sensor.kind == SensorSpec::Kind::range);
        CHECK(sensor.at.x == Approx(x));
        CHECK(sensor.at.y == Approx(y));
        CHECK(sensor.at.z > 0);
        CHECK(sensor.at.z < 0.07);
        CHECK(sensor.yaw == Approx(degrees * std::numbers::pi / 180));
        CHECK(sensor.range == 0.60);
        CHECK(sensor.noise == 0);
        REQUIRE(sensor.has_response);
        CHECK(sensor.response(0.01) == 1394);
        CHECK(sensor.response(0.20) == 36);
        CHECK(sensor.response(0.30) == 16);
        CHECK(sensor.response(0.60) == 0);
        CHECK(sensor.response(infinity) == 0);
        CHECK(sensor.response(0.005) > 1394);
        CHECK(sensor.response(0) == 4095);
    };
    check("right_front", 0.035, -0.040, 0);
    check("right_side", 0.045, -0.030, -45);
    check("left_side", 0.045, 0.030, 45);
    check("left_front", 0.035, 0.040, 0);
    const std::vector<std::string> order{"right_front", "right_side", "left_side", "left_front"};
    CHECK(port_of(mouse, "ir_sensor_out").items == order);
    CHECK(port_of(mouse, "ir_sensor_metre_out").items == order);
}

TEST_CASE("the mouse has its nine documented ports", "[lua][robot_file]") {
    const RobotSpec mouse = shipped("raspimouse.lua");
    const std::vector<std::tuple<std::string, bool, std::string>> expected{
        {"target_velocity_in", true, "TimedVelocity2D"},
        {"pose_update", true, "TimedPose2D"},
        {"buzzer_hz_in", true, "TimedShort"},
        {"led4bit_in", true, "TimedBooleanSeq"},
        {"current_velocity_out", false, "TimedVelocity2D"},
        {"current_pose_out", false, "TimedPose2D"},
        {"ir_sensor_out", false, "TimedShortSeq"},
        {"ir_sensor_metre_out", false, "TimedDoubleSeq"},
        {"switch3bit_out", false, "TimedBooleanSeq"}};
    CHECK(mouse.ports.size() == expected.size());
    for (const auto& [name, is_input, type] : expected) {
        const PortSpec& port = port_of(mouse, name);
        CHECK(port.is_input == is_input);
        CHECK(port.type == type);
        CHECK_FALSE(port.doc.empty());
    }
    CHECK(port_of(mouse, "ir_sensor_metre_out").quantity == PortSpec::Quantity::distance);
    CHECK(port_of(mouse, "buzzer_hz_in").off_when_silent);
    CHECK_FALSE(port_of(mouse, "led4bit_in").off_when_silent);
    CHECK(Robot::make("mouse", mouse, mouse.drive.limits).has_value());
}

TEST_CASE("the sensors of the swarm's robot follow their formula", "[lua][robot_file]") {
    const RobotSpec robot = shipped("swarm_robot.lua");
    CHECK(robot.mass == 1.6);
    CHECK(robot.drive.track == 0.14);
    CHECK(robot.body.shape == BodySpec::Shape::cylinder);
    CHECK(robot.body.size.x == 2 * 0.085);
    REQUIRE(robot.sensors.size() == 24);
    for (int i = 0; i < 24; ++i) {
        const SensorSpec& ray = robot.sensors[static_cast<std::size_t>(i)];
        const double angle = (7.5 + 15 * i) * std::numbers::pi / 180;
        CHECK(ray.yaw == Approx(angle));
        CHECK(ray.at.x == Approx(0.085 * std::cos(angle)));
        CHECK(ray.at.y == Approx(0.085 * std::sin(angle)));
        CHECK(ray.at.z == Approx(0.06));
        CHECK(ray.range == 0.1);
        CHECK(port_of(robot, "rays").items[static_cast<std::size_t>(i)] == ray.name);
    }
    const ResponseTable& nearness = robot.sensors[0].response;
    CHECK(nearness(0) == 1);
    CHECK(nearness(0.005) == 1);
    for (double d = 0.0105; d < 0.1; d += 0.001)
        CHECK(nearness(d) == Approx(0.0100527 / (d + 0.000163144)).epsilon(1e-3));
    CHECK(nearness(0.1001) == 0);
}

TEST_CASE("a user's robot needs only a body and wheels", "[lua][robot_file]") {
    const RobotSpec robot = robot_of(
        "return robot_model { mass = 2, body = { size = { 0.3, 0.2, 0.1 } }, drive = { radius = 0.05, track = 0.2 } }");
    CHECK(robot.body.shape == BodySpec::Shape::box);
    CHECK(robot.body.at.z == Approx(0.06));
    CHECK(robot.drive.skid == Approx(0.12));
    CHECK(robot.drive.limits == Limits{});
    CHECK(robot.model == "r");
}

TEST_CASE("every robot has ports for its wheels, its own or the mouse's", "[lua][robot_file]") {
    const RobotSpec plain = robot_of(with(""));
    REQUIRE(plain.ports.size() == 4);
    CHECK(port_of(plain, "target_velocity_in").items == std::vector<std::string>{"drive"});
    CHECK(port_of(plain, "pose_update").is_input);
    CHECK(port_of(plain, "current_velocity_out").items == std::vector<std::string>{"velocity"});
    CHECK(port_of(plain, "current_pose_out").type == "TimedPose2D");
    const RobotSpec own =
        robot_of(with("ports = { go = { type = 'TimedVelocity2D', to = 'drive' }, here = { type = 'TimedPose2D', from "
                      "= 'odometry' } }"));
    REQUIRE(own.ports.size() == 4);
    CHECK(port_of(own, "go").is_input);
    CHECK(port_of(own, "pose_update").is_input);
    CHECK(port_of(own, "current_velocity_out").items == std::vector<std::string>{"velocity"});
}

TEST_CASE("the smallest robot is wheels, a sensor and a port for it", "[lua][robot_file]") {
    const RobotSpec robot = robot_of(R"(return robot_model {
        mass  = 0.72,
        drive = { radius = 0.024, track = 0.0925 },
        sensors = { right_front = { kind = "range", at = { 0.035, -0.040, 0.0 }, yaw = 0.0, table = "ir_table.csv" } },
        ports = { ir_sensor_out = { type = "TimedShortSeq", from = { "right_front" } } },
      })");
    CHECK(robot.body.size.x == Approx(0.10).margin(0.01));
    CHECK(robot.body.at.z > robot.body.size.z / 2);
    CHECK(robot.sensors[0].response(0.02) == 792);
    CHECK(robot.ports.size() == 5);
}

TEST_CASE("the limits of a robot also apply to hardware, unless it has others for hardware", "[lua][robot_file]") {
    const RobotSpec robot = robot_of(
        "return robot_model { mass = 2, body = { size = { 0.3, 0.2, 0.1 } }, drive = { radius = 0.05, track = 0.2, "
        "limits = { speed = 2.0 }, hardware_limits = { yaw_rate = 1 } } }");
    CHECK(robot.drive.limits == Limits{2.0, 6, 2, 12});
    CHECK(robot.drive.hardware_limits == Limits{2.0, 1, 2, 12});
}

TEST_CASE("a robot file names the driver of the real robot, and the button that starts it", "[lua][robot_file]") {
    CHECK(shipped("raspimouse.lua").hardware.driver == "raspimouse");
    CHECK(shipped("raspimouse.lua").hardware.start.empty());
    const RobotSpec robot =
        robot_of(with("sensors = { go = { kind = 'button' } }, hardware = { driver = 'x', start = 'go' }"));
    CHECK(robot.hardware.driver == "x");
    CHECK(robot.hardware.start == "go");
}

TEST_CASE("the position of a sensor is relative to the hull's centre", "[lua][robot_file]") {
    const RobotSpec robot = robot_of(with(
        "sensors = { a = { kind = 'range', at = { 0.05, 0.01, -0.02 } }, b = { kind = 'range', at = { 0.05, 0 } } }"));
    CHECK(robot.body.at.z == Approx(0.06));
    CHECK(sensor_of(robot, "a").at.x == Approx(0.05));
    CHECK(sensor_of(robot, "a").at.y == Approx(0.01));
    CHECK(sensor_of(robot, "a").at.z == Approx(0.04));
    CHECK(sensor_of(robot, "b").at.z == Approx(0.06));
    CHECK_FALSE(sensor_of(robot, "a").has_response);
}

TEST_CASE("a response function is sampled when the file is read", "[lua][robot_file]") {
    const RobotSpec robot = robot_of(with(R"(sensors = {
        linear = { kind = "range", range = 2, response = function(d) return math.max(0, 100 - 50 * d) end },
        inverse = { kind = "range", range = 1, response = function(d) return 1 / d end, max_value = 50 },
        capped = { kind = "range", range = 1, response = function(d) if d == math.huge then return -1 end return 10 * d end, min_value = 2 },
        nothing = { kind = "range", range = 1, response = function(d) return 3 end, nothing = 9 } })"));
    const ResponseTable& linear = sensor_of(robot, "linear").response;
    CHECK(linear(0) == 100);
    CHECK(linear(0.5) == Approx(75));
    CHECK(linear(1.9) == Approx(5));
    CHECK(linear(infinity) == 0);
    const ResponseTable& inverse = sensor_of(robot, "inverse").response;
    CHECK(inverse(0) == 50);
    CHECK(inverse(0.5) == Approx(2).epsilon(1e-3));
    CHECK(inverse(infinity) == 0);
    CHECK(sensor_of(robot, "capped").response(0) == 2);
    CHECK(sensor_of(robot, "capped").response(infinity) == 2);
    CHECK(sensor_of(robot, "nothing").response(0.5) == 3);
    CHECK(sensor_of(robot, "nothing").response(infinity) == 9);
}

TEST_CASE("a response table is a file beside the robot file, or a list of points", "[lua][robot_file]") {
    const RobotSpec robot = robot_of(with(R"(sensors = {
        file = { kind = "range", table = "ir_table.csv" },
        points = { kind = "range", range = 1, table = { { 0.1, 10 }, { 0.5, 4 } }, max_value = 12 } })"));
    const SensorSpec& file = sensor_of(robot, "file");
    CHECK(file.range == 0.60);
    CHECK(file.response(0.02) == 792);
    CHECK(file.response(0) == 4095);
    const ResponseTable& points = sensor_of(robot, "points").response;
    CHECK(points(0.1) == 10);
    CHECK(points(0.3) == Approx(7));
    CHECK(points(0.75) == Approx(2));
    CHECK(points(0) == 12);

    const Scratch scratch;
    scratch.write("mine.csv", "distance_m,value\n0.1,9\n0.2,x\n");
    const auto path = scratch.write("mine.lua", with("sensors = { a = { kind = 'range', table = 'mine.csv' } }"));
    const auto bad = read_robot_file(path, Project::of(path));
    REQUIRE_FALSE(bad.has_value());
    CHECK(describe(bad.error()) ==
          scratch.path("mine.csv").string() + ":3: column 'value': expected a number, got 'x'");
}

TEST_CASE("the files that a robot was read from are known", "[lua][robot_file]") {
    std::vector<std::string> files;
    const auto path = root / "engine/robots/raspimouse.lua";
    REQUIRE(read_robot_file(path, Project::of(path), &files).has_value());
    CHECK(files == std::vector<std::string>{"engine/robots/raspimouse.lua", "engine/robots/ir_table.csv"});
}

TEST_CASE("a robot file sets noise of sensors and friction of wheels", "[lua][robot_file]") {
    const RobotSpec plain = robot_of(with(""));
    CHECK(plain.noise == 0);
    CHECK(plain.friction == 1);
    const RobotSpec spec = robot_of(with("noise = 0.05, friction = 0.8"));
    CHECK(spec.noise == 0.05);
    CHECK(spec.friction == 0.8);
    CHECK(robot_error(with("noise = 5")) ==
          "r.lua:2:1: robot_model: field 'noise' expected a number from 0 to 1, got 5");
    CHECK(robot_error(with("friction = -1")) ==
          "r.lua:2:1: robot_model: field 'friction' expected a number from 0 on, got -1");
}

TEST_CASE("a scan covers a full turn by default", "[lua][robot_file]") {
    const RobotSpec spec = robot_of(with(
        "sensors = { all = { kind = 'scan', range = 4 }, ahead = { kind = 'scan', cone = math.rad(180), rays = 181, "
        "minimum = 0.1, noise = 0.01 } }, ports = { all = { type = 'RangeData', from = 'all', rate = 10 }, "
        "ahead = { type = 'TimedDoubleSeq', from = 'ahead' } }"));
    const SensorSpec& all = sensor_of(spec, "all");
    CHECK(all.kind == SensorSpec::Kind::scan);
    CHECK(all.cone == Approx(2 * M_PI));
    CHECK(all.rays == 360);
    CHECK(angles_of(all).first == Approx(-M_PI));
    CHECK(angles_of(all).step == Approx(M_PI / 180));  // the last ray is not the first
    const SensorSpec& ahead = sensor_of(spec, "ahead");
    CHECK(angles_of(ahead).first == Approx(-M_PI / 2));
    CHECK(angles_of(ahead).step == Approx(M_PI / 180));
    CHECK(ahead.noise == 0.01);
    CHECK(robot_error(with("sensors = { a = { kind = 'scan', cone = 7 } }")) ==
          "r.lua:2:34: robot_model: field 'sensors.a.cone' expected a field of view above 0 and up to 2 pi rad, got 7");
    CHECK(robot_error(with("sensors = { a = { kind = 'scan', rays = 1 } }")) ==
          "r.lua:2:34: robot_model: field 'sensors.a.rays' expected 2 or more rays, got 1: for a single ray use "
          "kind = 'range'");
    CHECK(robot_error(with("sensors = { a = { kind = 'scan', minimum = 2 } }")) ==
          "r.lua:2:34: robot_model: field 'sensors.a.minimum' expected less than the range of 0.6 m, got 2");
    CHECK(robot_error(with("sensors = { a = { kind = 'scan', table = 'x.csv' } }"))
              .find("unknown field 'sensors.a.table'") != std::string::npos);
}

TEST_CASE("a sensor of neighbours has a port of its own type, and what a robot says another", "[lua][robot_file]") {
    const auto error = [](const std::string& ports) {
        const std::string text =
            robot_error(with("sensors = { near = { kind = 'neighbours' }, far = { kind = 'neighbours' }, eye = { "
                             "kind = 'range' } }, ports = { " +
                             ports + " }"));
        return text.substr(std::min(text.size(), text.find("port '")));
    };
    CHECK(error("near = { type = 'NeighbourSeq', from = 'near', rate = 5 }, say = { type = 'TimedDoubleSeq', to = "
                "'say' }") == "");
    CHECK(error("p = { type = 'TimedDoubleSeq', from = 'near' }") ==
          "port 'p': 'near' sees neighbours: its type is NeighbourSeq, not TimedDoubleSeq");
    CHECK(error("p = { type = 'NeighbourSeq', from = 'eye' }") ==
          "port 'p': a NeighbourSeq carries neighbours, and 'eye' is another kind of sensor");
    CHECK(error("p = { type = 'NeighbourSeq', from = { 'near', 'far' } }") == "port 'p': 'near' needs its own port");
    CHECK(error("p = { type = 'NeighbourSeq', from = 'near', quantity = 'distance' }") ==
          "port 'p': 'near' is a neighbours sensor, which has no `quantity`");
    CHECK(error("p = { type = 'TimedLongSeq', to = 'say' }") ==
          "port 'p': 'say' takes a TimedDoubleSeq, not a TimedLongSeq");
    CHECK(error("p = { type = 'TimedDoubleSeq', to = 'say' }, q = { type = 'TimedDoubleSeq', to = 'say' }") ==
          "port 'q': a robot can have only one in-port for what it says");
}

TEST_CASE("an imu's ports carry its rates, its accelerations or both", "[lua][robot_file]") {
    const RobotSpec spec = robot_of(
        with("sensors = { imu = { kind = 'imu', noise = 0.01, acceleration_noise = 0.1, max_rate = 4 } }, ports = "
             "{ rates = { type = 'TimedDoubleSeq', from = 'imu', quantity = 'rate' }, accelerations = { type = "
             "'TimedDoubleSeq', from = 'imu', quantity = 'acceleration' }, both = { type = 'TimedFloatSeq', from "
             "= 'imu' } }"));
    CHECK(sensor_of(spec, "imu").acceleration_noise == 0.1);
    CHECK(port_of(spec, "accelerations").quantity == PortSpec::Quantity::acceleration);
    CHECK(robot_error(
              with("sensors = { imu = { kind = 'imu' } }, ports = { p = { type = 'TimedDouble', from = 'imu' } }")) ==
          "r.lua:2:49: robot_model: port 'p': 'imu' has several values, and a TimedDouble carries one");
    CHECK(robot_error(with("sensors = { imu = { kind = 'imu' }, g = { kind = 'gyro' } }, ports = { p = { type = "
                           "'TimedDoubleSeq', from = { 'imu', 'g' } } }")) ==
          "r.lua:2:72: robot_model: port 'p': 'imu' has several values: it needs its own port");
    CHECK(robot_error(with(
              "sensors = { g = { kind = 'gyro' } }, ports = { p = { type = 'TimedDouble', from = 'g', quantity = "
              "'acceleration' } }")) == "r.lua:2:48: robot_model: port 'p': 'g' is not an imu: it has no acceleration");
}

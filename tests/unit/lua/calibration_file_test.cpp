// Calibration files: what they say of a robot, whose they are, and what is refused.
#include "bindings/lua/files/calibration_file.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "bindings/lua/files/system_file.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

struct CalibratedProject {
    Scratch folder;
    std::string system = "robot 'mouse' { model = 'raspimouse', calibrated = true }";

    Expected<SystemSpec> read() const {
        const auto file = folder.write("system.lua", system);
        return read_system_file(file, Project::of(file, {source_root()}));
    }
    std::string refused(const std::string& calibration) const {
        folder.write("mouse.calibration.lua", calibration);
        const auto spec = read();
        if (spec) return "";
        const std::string text = describe(spec.error());
        const std::string path = folder.path("").string();
        return text.find(path) == 0 ? text.substr(path.size()) : text;
    }
};

const std::string head = "calibration { robot = 'mouse', model = 'raspimouse', ";

}  // namespace

TEST_CASE("a calibration changes the description, and the hardware gets the limits of the model",
          "[lua][calibration]") {
    const CalibratedProject project;
    Calibration calibration{.robot = "mouse", .model = "raspimouse"};
    calibration.odometry = {.track = 0.0955, .left_radius = 0.0243, .right_radius = 0.0238};
    calibration.ranges = {{"right_front", {{0.02, 900.5}, {0.1, 50}}}};
    project.folder.write("mouse.calibration.lua", write_calibration(calibration));
    const auto spec = project.read();
    REQUIRE(spec);
    const auto& robot = std::get<RobotEntry>(spec->entries.front());
    CHECK(robot.model == "raspimouse");
    const RobotSpec& own = spec->models.at(robot.described_by());
    CHECK(own.drive.track == 0.0955);
    CHECK(own.drive.radius_of_left() == 0.0243);
    CHECK(own.drive.radius_of_right() == 0.0238);
    CHECK(own.drive.hardware_limits == own.drive.limits);
    const auto sensor = std::find_if(own.sensors.begin(), own.sensors.end(),
                                     [](const SensorSpec& each) { return each.name == "right_front"; });
    REQUIRE(sensor != own.sensors.end());
    CHECK(sensor->response(0.02) == 900.5);
    CHECK(sensor->response(1) == 0);
    CHECK(spec->models.at("raspimouse").drive.track == 0.0925);
    CHECK(spec->files.back() == project.folder.path("mouse.calibration.lua").string());
}

TEST_CASE("without calibrated wheels the limits of the hardware do not change", "[lua][calibration][safety]") {
    const CalibratedProject project;
    CHECK(project.refused(head + "sensors = { right_front = { table = { { 0.02, 9 }, { 0.1, 5 } } } } }").empty());
    const auto spec = project.read();
    REQUIRE(spec);
    const RobotSpec& own = spec->models.at(std::get<RobotEntry>(spec->entries.front()).described_by());
    CHECK(own.drive.hardware_limits.speed == 0.2);
}

TEST_CASE("a simulated robot uses its calibration only with calibrated = true", "[lua][calibration]") {
    CalibratedProject project;
    project.system = "robot 'mouse' { model = 'raspimouse' }";
    CHECK(project.refused("this is no Lua").empty());
    CHECK(std::get<RobotEntry>(project.read()->entries.front()).described_by() == "raspimouse");
}

TEST_CASE("a robot without the required calibration is refused", "[lua][calibration]") {
    const CalibratedProject project;
    const auto spec = project.read();
    REQUIRE_FALSE(spec);
    CHECK(spec.error().place.line == 1);
    CHECK(spec.error().message == "robot 'mouse': calibrated = true, and there is no " +
                                      project.folder.path("mouse.calibration.lua").string() +
                                      ": make it by nezumi calibrate");
}

TEST_CASE("another robot's calibration is refused", "[lua][calibration]") {
    const CalibratedProject project;
    CHECK(project.refused("calibration { robot = 'moose', model = 'raspimouse' }") ==
          "mouse.calibration.lua: is the calibration of another robot: its name is 'moose', not 'mouse'. Calibrate "
          "this robot, or move the file away");
    CHECK(project.refused("calibration { robot = 'mouse', model = 'ev3' }") ==
          "mouse.calibration.lua: is the calibration of another robot: its model is 'ev3', not 'raspimouse'. Calibrate "
          "this robot, or move the file away");
}

TEST_CASE("the serial number of the computer distinguishes two robots", "[lua][calibration]") {
    const CalibratedProject project;
    CHECK(project.refused(head + "serial = '00000000aaaa' }").empty());
    auto spec = project.read();
    REQUIRE(spec);
    auto& robot = std::get<RobotEntry>(spec->entries.front());
    robot.description.clear();
    const Project files = Project::of(spec->file, {source_root()});
    const auto other = use_calibration(*spec, robot, files, {.is_needed = false, .serial = "00000000bbbb"});
    REQUIRE_FALSE(other);
    CHECK(other.error().message ==
          "is the calibration of another robot: its computer's number is '00000000aaaa', not "
          "'00000000bbbb'. Calibrate this robot, or move the file away");
    const auto none = use_calibration(*spec, robot, files, {.is_needed = false, .serial = ""});
    REQUIRE_FALSE(none);
    CHECK(none.error().message.find("its computer's number is '00000000aaaa', not ''") != std::string::npos);
    CHECK(use_calibration(*spec, robot, files, {.is_needed = false, .serial = "00000000aaaa"}));
}

TEST_CASE("wheels of twice or half the model's size are refused", "[lua][calibration]") {
    const CalibratedProject project;
    CHECK(project.refused(head + "odometry = { track = 0.0925, left_radius = 2.4, right_radius = 0.024 } }") ==
          "mouse.calibration.lua: odometry.left_radius is 2.4 m, but model 'raspimouse' has 0.024 m: the "
          "calibration is of another robot, or it is wrong. Calibrate it again with nezumi calibrate odometry");
    CHECK(project.refused(head + "odometry = { track = 0.04, left_radius = 0.024, right_radius = 0.024 } }")
              .find("odometry.track is 0.04 m") != std::string::npos);
    CHECK(project.refused(head + "odometry = { track = 0.1, left_radius = 0.03, right_radius = 0.02 } }").empty());
}

TEST_CASE("an incomplete calibration file is refused, wherever it ends", "[lua][calibration]") {
    const CalibratedProject project;
    Calibration calibration{.robot = "mouse", .model = "raspimouse", .serial = "12"};
    calibration.odometry = {.track = 0.0955, .left_radius = 0.0243, .right_radius = 0.0238};
    calibration.ranges = {{"right_front", {{0.02, 900.5}, {0.1, 50}}}};
    calibration.cameras["eye"] = {.width = 640, .height = 480, .fx = 520, .fy = 520};
    const std::string whole = write_calibration(calibration);
    CHECK(project.refused(whole).empty());
    for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
        CAPTURE(length);
        const std::string said = project.refused(whole.substr(0, length));
        CHECK(said.starts_with("mouse.calibration.lua"));
        CHECK(said.find('\n') == said.npos);
    }
}

TEST_CASE("the error about a wrong field of a calibration has its line", "[lua][calibration]") {
    const CalibratedProject project;
    CHECK(project.refused(head + "\nodometry = { track = 0.09 } }") ==
          "mouse.calibration.lua:2:1: calibration: field 'odometry.left_radius' is missing: expected a positive number "
          "in m");
    CHECK(project.refused(head + "sensors = { right_fornt = { table = { { 0.02, 9 }, { 0.1, 5 } } } } }") ==
          "mouse.calibration.lua: model 'raspimouse' has no range sensor 'right_fornt' (did you mean 'right_front'?)");
    CHECK(project.refused(head + "sensors = { right_front = { table = { { 0.1, 9 }, { 0.02, 5 } } } } }") ==
          "mouse.calibration.lua: sensor 'right_front': distances must ascend: 0.02 m comes after 0.1 m");
    CHECK(project.refused(head + "odometri = {} }").find("odometri") != std::string::npos);
}

TEST_CASE("a camera on a calibrated robot has the measured intrinsics", "[lua][calibration][camera]") {
    CalibratedProject project;
    project.system += "\ncomponent 'eye' { type = 'Camera', on = 'mouse', config = { k1 = 0.1 } }";
    Calibration calibration{.robot = "mouse", .model = "raspimouse"};
    calibration.cameras["eye"] = {.width = 640,
                                  .height = 480,
                                  .fx = 521.25,
                                  .fy = 520,
                                  .cx = 318,
                                  .cy = 241.5,
                                  .k1 = -0.25,
                                  .k2 = 0.08,
                                  .p1 = 0.001,
                                  .p2 = -0.002,
                                  .k3 = -0.01};
    const std::string text = write_calibration(calibration);
    CHECK(
        text.find("    eye = { width = 640, height = 480, fx = 521.25, fy = 520.0, cx = 318.0, cy = 241.5, k1 = -0.25, "
                  "k2 = 0.08, p1 = 0.001, p2 = -0.002, k3 = -0.01, },\n") != std::string::npos);
    project.folder.write("mouse.calibration.lua", text);
    auto spec = project.read();
    INFO((spec ? "" : describe(spec.error())));
    REQUIRE(spec);
    const auto& config = std::get<ComponentEntry>(spec->entries.back()).config;
    CHECK(config.size() == 12);
    CHECK(config.at("fx").get<double>() == 521.25);
    CHECK(config.at("cy").get<double>() == 241.5);
    CHECK(config.at("k1").get<double>() == -0.25);
}

TEST_CASE("a camera that was calibrated with pictures of another size is refused", "[lua][calibration][camera]") {
    CalibratedProject project;
    project.system += "\ncomponent 'eye' { type = 'Camera', on = 'mouse', config = { width = 320, height = 240 } }";
    const std::string lens = "fx = 500, fy = 500, cx = 300, cy = 200, k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0 } } }";
    const std::string said = project.refused(head + "cameras = { eye = { width = 640, height = 480, " + lens);
    CHECK(
        said ==
        "system.lua:2: camera 'eye' was calibrated with 640 x 480 pixels, and here it has 320 x 240: set its width and "
        "height to that size, or calibrate it again with nezumi calibrate camera");
    CHECK(project.refused(head + "cameras = { nose = { width = 640, height = 480, " + lens).empty());
    CHECK(project.refused(head + "cameras = { eye = { width = 320, height = 240, " + lens).empty());
}

TEST_CASE("the error about a missing field of a camera's calibration has its line", "[lua][calibration][camera]") {
    const CalibratedProject project;
    CHECK(project.refused(head +
                          "\ncameras = { eye = { width = 640, height = 480, fx = 500, fy = 500, cx = 300, cy = 200, "
                          "k1 = 0, k2 = 0, p1 = 0, p2 = 0 } } }") ==
          "mouse.calibration.lua:2:13: calibration: field 'cameras.eye.k3' is missing: expected a number");
    CHECK(project.refused(head + "cameras = { eye = { fx = -1 } } }")
              .ends_with("calibration: field 'cameras.eye.fx' expected a positive number, got -1"));
}

TEST_CASE("a calibration applies to a robot with changes of its model", "[lua][calibration]") {
    CalibratedProject project;
    project.system = "robot 'mouse' { model = 'raspimouse', calibrated = true, noise = 0.1, mass = 1 }";
    CHECK(project.refused(head + "odometry = { track = 0.1, left_radius = 0.024, right_radius = 0.025 } }").empty());
    const auto spec = project.read();
    REQUIRE(spec);
    const auto& robot = std::get<RobotEntry>(spec->entries.front());
    const RobotSpec& own = spec->models.at(robot.described_by());
    CHECK(own.drive.track == 0.1);
    CHECK(own.noise == 0.1);
    CHECK(own.mass == 1);
    CHECK(robot.changes == "{ mass = 1, noise = 0.1 }");
}

// Robots that differ from others: robot files that build on robot files, robots of a system that differ from their
// model.
#include "bindings/lua/files/system_text.hpp"
#include "tests/unit/lua/robot_reader.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;

namespace {

// A folder with robot files, and systems that use them.
struct Robots {
    Robots() {
        folder.write("behaviors/steps.csv", "distance_m,value\n0.1,100\n0.2,50\n");
        folder.write("behaviors/plain.lua", R"(
            return robot_model {
              mass = 1, body = { size = { 0.1, 0.1, 0.1 } }, drive = { radius = 0.02, track = 0.1 },
              sensors = {
                left = { kind = "range", at = { 0.05, 0.02 }, response = function(d) return 1 / (1 + d) end },
                right = { kind = "range", at = { 0.05, -0.02 }, table = "steps.csv", noise = 3 },
              },
              ports = { both = { type = "TimedDoubleSeq", from = { "right", "left" } } },
            })");
    }

    Expected<RobotSpec> read(const std::string& text) const {
        const auto file = folder.path("behaviors/mine.lua");
        return read_robot_text(text, file.string(), Project::of(file));
    }
    RobotSpec robot(const std::string& fields) const {
        auto spec = read("return robot_model { base = 'plain', " + fields + " }");
        INFO((spec ? std::string() : describe(spec.error())));
        REQUIRE(spec.has_value());
        return std::move(*spec);
    }
    std::string error(const std::string& fields) const {
        const auto spec = read("return robot_model { base = 'plain', " + fields + " }");
        return spec ? "no error" : spec.error().message;
    }
    Expected<SystemSpec> system(const std::string& text) const {
        const auto file = folder.path("behaviors/s.lua");
        return read_system_text(text, file.string(), Project::of(file));
    }
    // The robot "m" of a system, with these fields.
    RobotSpec in_system(const std::string& fields) const {
        auto spec = system("robot 'm' { model = 'plain', " + fields + " }");
        INFO((spec ? std::string() : describe(spec.error())));
        REQUIRE(spec.has_value());
        return spec->models.at(std::get<RobotEntry>(spec->entries.front()).described_by());
    }
    std::string system_error(const std::string& fields) const {
        const auto spec = system("robot 'm' { model = 'plain',\n" + fields + " }");
        if (spec) return "no error";
        return std::to_string(spec.error().place.line) + ": " + spec.error().message;
    }

    Scratch folder;
};

using robot_files::port_of;
using robot_files::sensor_of;

}  // namespace

TEST_CASE("a robot file with a base has the fields of the base unless it sets them", "[lua][robot_file]") {
    const Robots robots;
    const RobotSpec spec = robots.robot(
        "mass = 2, noise = 0.1, drive = { track = 0.2, limits = { speed = 0.3 } }, "
        "sensors = { right = { noise = 8 } }");
    CHECK(spec.model == "mine");
    CHECK(spec.mass == 2);
    CHECK(spec.noise == 0.1);
    CHECK(spec.drive.track == 0.2);
    CHECK(spec.drive.radius == 0.02);
    CHECK(spec.drive.limits.speed == 0.3);
    CHECK(spec.drive.limits.yaw_rate == Limits{}.yaw_rate);
    CHECK(spec.body.size == Point3D{0.1, 0.1, 0.1});
    CHECK(sensor_of(spec, "right").noise == 8);
    CHECK(sensor_of(spec, "right").response(0.1) == 100);
    CHECK(sensor_of(spec, "right").at.y == -0.02);
    CHECK(sensor_of(spec, "left").response(0.0) == 1);
    CHECK(port_of(spec, "both").items == std::vector<std::string>{"right", "left"});
}

TEST_CASE("a response function of the base is sampled again for a longer range", "[lua][robot_file]") {
    const Robots robots;
    const RobotSpec spec = robots.robot("sensors = { left = { range = 3 } }");
    CHECK(sensor_of(spec, "left").response(2.0) == Approx(1 / 3.0).margin(1e-3));
}

TEST_CASE("lists and positions are replaced as a whole", "[lua][robot_file]") {
    const Robots robots;
    const RobotSpec spec =
        robots.robot("sensors = { left = { at = { x = 0.01, y = 0.03 } } }, ports = { both = { from = { 'left' } } }");
    CHECK(sensor_of(spec, "left").at.x == 0.01);
    CHECK(sensor_of(spec, "left").at.y == 0.03);
    CHECK(sensor_of(spec, "left").at.z == Approx(0.06));  // the height of the hull's centre
    CHECK(port_of(spec, "both").items == std::vector<std::string>{"left"});
    CHECK(port_of(spec, "both").type == "TimedDoubleSeq");
}

TEST_CASE("false removes a sensor or port, unless a port needs it", "[lua][robot_file]") {
    const Robots robots;
    const RobotSpec spec = robots.robot("sensors = { left = false }, ports = { both = { from = 'right' } }");
    CHECK(spec.sensors.size() == 1);
    CHECK(robots.robot("body = false").body.size.x == Approx(0.11));  // as of a robot without one
    CHECK(robots.error("sensors = { left = false }") == "robot_model: port 'both': there is no sensor 'left'");
    CHECK(robots.error("sensors = { lefft = false }") ==
          "robot_model: field 'sensors.lefft' can't be removed: it does not exist (did you mean 'left'?)");
    CHECK(robots.error("sensors = { lefft = { noise = 8 } }") ==
          "robot_model: unknown field 'sensors.lefft' (did you mean 'left'?)");
    CHECK(robots.error("ports = { bot = { from = 'left' } }") ==
          "robot_model: unknown field 'ports.bot' (did you mean 'both'?)");
    CHECK_THAT(robots.error("sensors = { extra = { noise = 8 } }"),
               Catch::Contains("field 'sensors.extra.kind' is missing: expected one of range"));
    CHECK(robots.robot("sensors = { lefft = { kind = 'button' } }").sensors.size() == 3);
    CHECK(robots.error("mass = false") ==
          "robot_model: field 'mass' is missing: expected a positive number in kg: of the whole robot");
}

TEST_CASE("false removes only its own one of two alternative fields, and both together are refused",
          "[lua][robot_file]") {
    const Robots robots;
    CHECK(sensor_of(robots.robot("sensors = { right = { table = false, response = function(d) return 2 * d end } }"),
                    "right")
              .response(0.5) == Approx(1.0));
    CHECK(robots.error("sensors = { right = { table = { { 0, 1 }, { 1, 0 } }, response = function(d) return d end } }")
              .find("'sensors.right.response'") != std::string::npos);
}

TEST_CASE("another kind, or an alternative field, replaces the old fields completely", "[lua][robot_file]") {
    const Robots robots;
    const RobotSpec spec = robots.robot(
        "sensors = { left = { kind = 'touch', travel = 0.01 }, right = { response = "
        "function(d) return d end } }, ports = { both = false }, "
        "body = { shape = 'cylinder', radius = 0.05, height = 0.1 }");
    CHECK(sensor_of(spec, "left").kind == SensorSpec::Kind::touch);
    CHECK(sensor_of(spec, "left").travel == 0.01);
    CHECK(sensor_of(spec, "right").response(0.5) == Approx(0.5));
    CHECK(spec.body.shape == BodySpec::Shape::cylinder);
    CHECK(spec.body.size == Point3D{0.1, 0.1, 0.1});
}

TEST_CASE("a robot file can't build on itself", "[lua][robot_file]") {
    const Robots robots;
    robots.folder.write("behaviors/heavy.lua", "return robot_model { base = 'plain', mass = 3 }");
    const auto spec = robots.read("return robot_model { base = 'heavy', noise = 0.2 }");
    REQUIRE(spec.has_value());
    CHECK(spec->mass == 3);
    CHECK(spec->noise == 0.2);
    CHECK(sensor_of(*spec, "left").response(0.0) == 1);  // its function is two files away
    CHECK(sensor_of(*spec, "right").response(0.2) == 50);

    robots.folder.write("behaviors/a.lua", "return robot_model { base = 'b' }");
    robots.folder.write("behaviors/b.lua", "return robot_model { base = 'a' }");
    const auto circle = robots.read("return robot_model { base = 'a' }");
    REQUIRE_FALSE(circle.has_value());
    CHECK(circle.error().message.find("can't be its own base") != std::string::npos);
    CHECK(circle.error().place.file.find("b.lua") != std::string::npos);

    const auto none = robots.read("return robot_model { base = 'plan' }");
    REQUIRE_FALSE(none.has_value());
    CHECK(none.error().message.find("robot_model: field 'base': ") == 0);
    CHECK(none.error().message.find("plan") != std::string::npos);
    CHECK(robots.read("return robot_model { base = 5 }").error().message ==
          "robot_model: field 'base' expected a string, got number");
}

TEST_CASE("a robot of a system can change any field of its model", "[lua][system_file]") {
    const Robots robots;
    const RobotSpec spec = robots.in_system(
        "noise = 0.05, friction = 0.8, mass = 1.5, sensors = { right = { noise = 8 }, extra = { kind = 'button' } }, "
        "ports = { pressed = { type = 'TimedBoolean', from = 'extra' } }, hardware = { driver = 'raspimouse' }, "
        "limits = { speed = 0.3 }");
    CHECK(spec.noise == 0.05);
    CHECK(spec.friction == 0.8);
    CHECK(spec.mass == 1.5);
    CHECK(spec.hardware.driver == "raspimouse");
    CHECK(sensor_of(spec, "right").noise == 8);
    CHECK(sensor_of(spec, "right").response(0.1) == 100);
    CHECK(port_of(spec, "pressed").items == std::vector<std::string>{"extra"});
    CHECK(spec.drive.limits.speed == Limits{}.speed);  // those of the entry go on top
}

TEST_CASE("robots with the same changes share a description", "[lua][system_file]") {
    const Robots robots;
    const auto spec = robots.system(
        "for i = 1, 3 do robot('r' .. i) { model = 'plain', noise = 0.1 } end\n"
        "robot 'other' { model = 'plain', noise = 0.2 } robot 'as_it_is' { model = 'plain' }");
    REQUIRE(spec.has_value());
    CHECK(spec->models.size() == 3);
    CHECK(spec->models.at("plain").noise == 0);
    CHECK(std::get<RobotEntry>(spec->entries[0]).described_by() ==
          std::get<RobotEntry>(spec->entries[2]).described_by());
    CHECK(spec->models.at(std::get<RobotEntry>(spec->entries[3]).described_by()).noise == 0.2);
    CHECK(std::get<RobotEntry>(spec->entries[4]).described_by() == "plain");
}

TEST_CASE("an error in the changes of a robot has its location", "[lua][system_file]") {
    const Robots robots;
    CHECK(robots.system_error("noise = 5") == "2: robot 'm': field 'noise' expected a number from 0 to 1, got 5");
    CHECK(robots.system_error("nois = 0.1") == "2: robot 'm': unknown field 'nois' (did you mean 'noise'?)");
    CHECK(robots.system_error("sensors = { right = { nose = 8 } }") ==
          "2: robot 'm': unknown field 'sensors.right.nose' (did you mean 'noise'?)");
    CHECK(robots.system_error("sensors = { rigt = { noise = 8 } }") ==
          "2: robot 'm': unknown field 'sensors.rigt' (did you mean 'right'?)");
    CHECK(robots.system_error("base = 'plain'").find("unknown field 'base'") != std::string::npos);
    CHECK(robots.system_error("sensors = { left = { response = function(d) return d end } }") ==
          "2: robot 'm': field 'sensors.left.response': only a robot file can have a function: write a robot file with "
          "base = ..., or give a 'table'");
}

TEST_CASE("a saved system contains the changes of its robots", "[lua][system_text]") {
    const Robots robots;
    const auto spec = robots.system(
        "robot 'm' { model = 'plain', noise = 0.05, sensors = { right = { noise = 8, at = { 0.1, 0.0 } } }, ports = { "
        "both = false } }");
    REQUIRE(spec.has_value());
    const std::string text = write_system_text(*spec, "Saved");
    CHECK(
        text.find("robot(\"m\", { model = \"plain\", noise = 0.05, ports = { both = false }, sensors = { right = { at "
                  "= { 0.1, 0.0 }, noise = 8 } } })") != std::string::npos);
    const auto again = robots.system(text);
    REQUIRE(again.has_value());
    const RobotSpec& robot = again->models.at(std::get<RobotEntry>(again->entries.front()).described_by());
    CHECK(robot.noise == 0.05);
    CHECK(sensor_of(robot, "right").noise == 8);
    CHECK(write_system_text(*again, "Saved") == text);
}

TEST_CASE("the text of changes is read as the same changes", "[lua][robot_file]") {
    const Robots robots;
    const auto file = robots.folder.path("behaviors/plain.lua");
    const auto spec =
        read_changed_robot(file, "{ noise = 0.05, sensors = { right = { noise = 8 } } }", Project::of(file));
    REQUIRE(spec.has_value());
    CHECK(spec->noise == 0.05);
    CHECK(spec->model == "plain");
    CHECK(sensor_of(*spec, "right").noise == 8);
    CHECK_FALSE(read_changed_robot(file, "{ nois = 0.05 }", Project::of(file)).has_value());
}

// The EV3's body in the simulator: touch, ultrasonic beam, servo, colour sensor, and pushing.
#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "bindings/lua/files/robot_file.hpp"
#include "tests/unit/sim/try_world.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::sim;
namespace fs = std::filesystem;

namespace {

RobotSpec ev3() {
    const fs::path file = source_root() + "/engine/robots/ev3.lua";
    auto spec = read_robot_file(file, Project::of(file));
    INFO((spec ? "" : describe(spec.error())));
    REQUIRE(spec);
    return std::move(*spec);
}

std::size_t sensor(const RobotSpec& spec, std::string_view name) {
    const auto found =
        std::find_if(spec.sensors.begin(), spec.sensors.end(), [&](const auto& s) { return s.name == name; });
    REQUIRE(found != spec.sensors.end());
    return static_cast<std::size_t>(found - spec.sensors.begin());
}

std::size_t servo(const RobotSpec& spec) {
    const auto found = std::find_if(spec.actuators.begin(), spec.actuators.end(),
                                    [](const auto& a) { return a.kind == ActuatorSpec::Kind::servo; });
    return static_cast<std::size_t>(found - spec.actuators.begin());
}

double distance(const TryWorld& w) {
    std::vector<double> seen(1);
    w.bodies[0]->read_ranges(seen);
    return seen[0];
}

BoxSpec block(double x, double y, double mass = 0) {
    return {.at = {x, y, 0.1}, .size = {0.1, 0.1, 0.2}, .mass = mass};
}

// A picture file of one row of pixels.
struct FloorFile {
    explicit FloorFile(const std::vector<unsigned char>& rgb)
        : path(fs::temp_directory_path() / ("nezumi-floor-" + std::to_string(getpid()) + ".png")) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = static_cast<png_uint_32>(rgb.size() / 3);
        image.height = 1;
        image.format = PNG_FORMAT_RGB;
        REQUIRE(png_image_write_to_file(&image, path.c_str(), 0, rgb.data(), 0, nullptr) != 0);
    }
    ~FloorFile() { fs::remove(path); }
    fs::path path;
};

}  // namespace

TEST_CASE("the EV3's touch sensors close when it drives against an obstacle, and open again", "[sim][ev3]") {
    const RobotSpec spec = ev3();
    const std::size_t right = sensor(spec, "right"), left = sensor(spec, "left");
    for (const auto& [y, hits_right, hits_left] :
         {std::tuple{0.0, true, true}, {-0.06, true, false}, {0.06, false, true}}) {
        INFO("block at y = " << y);
        ArenaSpec arena;
        arena.boxes.push_back(block(0.3, y));
        TryWorld w(arena);
        w.add(spec, 0, 0);
        CHECK_FALSE(w.bodies[0]->is_pressed(right));
        w.bodies[0]->set_wheel_speeds({0.1, 0.1});
        w.run(1.2);
        CHECK_FALSE(w.bodies[0]->is_pressed(right));
        CHECK_FALSE(w.bodies[0]->is_pressed(left));
        bool collided = false, closed_right = false, closed_left = false;
        w.run(0.8, [&] {  // later the block turns it
            collided = collided || w.world->collided(0);
            closed_right = closed_right || w.bodies[0]->is_pressed(right);
            closed_left = closed_left || w.bodies[0]->is_pressed(left);
        });
        CHECK(collided);
        CHECK(closed_right == hits_right);
        CHECK(closed_left == hits_left);
        w.bodies[0]->set_wheel_speeds({-0.1, -0.1});
        w.run(1.0);
        CHECK_FALSE(w.bodies[0]->is_pressed(right));
        CHECK_FALSE(w.bodies[0]->is_pressed(left));
    }
}

TEST_CASE("the EV3's touch sensors close within their 4 mm of travel", "[sim][ev3]") {
    const RobotSpec spec = ev3();
    const std::size_t right = sensor(spec, "right");
    for (const auto& [gap, closed] : {std::pair{0.005, false}, {0.0035, false}, {0.0005, true}}) {
        INFO("gap to the hull " << gap);
        ArenaSpec arena;
        arena.boxes.push_back(block(0.08 + gap + 0.05, 0));
        TryWorld w(arena);
        w.add(spec, 0, 0);
        w.run(0.05);
        CHECK(w.bodies[0]->is_pressed(right) == closed);
    }
}

TEST_CASE("the EV3's ultrasonic sensor sees 2.5 m ahead in a beam", "[sim][ev3]") {
    const RobotSpec spec = ev3();
    const auto seen_at = [&](double x, double y) {
        ArenaSpec arena;
        arena.boxes.push_back(block(x, y));
        TryWorld w(arena);
        w.add(spec, 0, 0);
        w.run(0.1);
        return distance(w);
    };
    CHECK(seen_at(1.12, 0) == Approx(1.0).margin(0.001));  // from the sensor at x = 0.07 to the face
    CHECK(seen_at(2.61, 0) == Approx(2.49).margin(0.001));
    CHECK_FALSE(seen_at(2.7, 0) < 2.5);
    CHECK(seen_at(1.12, 0.2) == Approx(1.01).margin(0.01));  // 9 degrees aside: within the beam of 20
    CHECK_FALSE(seen_at(1.12, 0.5) < 2.5);
}

TEST_CASE("the EV3's medium motor turns the ultrasonic sensor", "[sim][ev3]") {
    const RobotSpec spec = ev3();
    ArenaSpec arena;
    arena.boxes.push_back(block(0.07, 1.05));  // straight to the left of the sensor
    TryWorld w(arena);
    w.add(spec, 0, 0);
    w.run(0.1);
    CHECK_FALSE(distance(w) < 2.5);
    w.bodies[0]->set_servo(servo(spec), M_PI / 2);
    CHECK(distance(w) == Approx(1.0).margin(0.001));
    w.bodies[0]->set_servo(servo(spec), -M_PI / 2);
    CHECK_FALSE(distance(w) < 2.5);
}

TEST_CASE("the EV3 sees the floor's picture, and nothing outside it", "[sim][ev3][floor]") {
    const RobotSpec spec = ev3();
    const std::size_t color = sensor(spec, "color"), reflect = sensor(spec, "light_reflect");
    const FloorFile file({0, 0, 0, 255, 0, 0, 255, 255, 255});
    ArenaSpec arena;
    arena.floor = FloorSpec{.image = file.path.string(), .size = {3, 1}};
    TryWorld w(arena);
    w.add(spec, -1, 0);
    const auto look = [&](double x, FloorColor expected, double light) {
        REQUIRE(w.world->teleport(0, {{x, 0}, 0}));
        w.run(0.05);
        INFO(x);
        CHECK(to_text(w.bodies[0]->floor_color(color)) == to_text(expected));
        CHECK(w.bodies[0]->reflected_light(reflect) == Approx(light).margin(0.1));
    };
    look(-1, FloorColor::black, 0);
    look(0, FloorColor::red, 29.9);
    look(1, FloorColor::white, 100);
    look(1.42, FloorColor::white, 100);  // the sensor is 6 cm ahead: still on the picture
    look(1.5, FloorColor::none, 0);
    look(-5, FloorColor::none, 0);
}

TEST_CASE("the EV3's colour sensor reads the floor from at most 18 mm above it", "[sim][ev3][floor]") {
    const FloorFile file({255, 0, 0});
    ArenaSpec arena;
    arena.floor = FloorSpec{.image = file.path.string(), .size = {3, 3}};
    for (const auto& [height, expected] : {std::pair{0.017, FloorColor::red}, {0.019, FloorColor::none}}) {
        RobotSpec spec = ev3();
        const std::size_t color = sensor(spec, "color");
        CHECK(spec.sensors[color].at.z < 0.018);
        spec.sensors[color].at.z = height;
        TryWorld w(arena);
        w.add(spec, 0, 0);
        CHECK(to_text(w.bodies[0]->floor_color(color)) == to_text(expected));
    }
}

TEST_CASE("without a picture on the floor the EV3 sees no colour", "[sim][ev3][floor]") {
    const RobotSpec spec = ev3();
    TryWorld w;
    w.add(spec, 0, 0);
    CHECK(w.bodies[0]->floor_color(sensor(spec, "color")) == FloorColor::none);
    CHECK(w.bodies[0]->reflected_light(sensor(spec, "light_reflect")) == 0);
}

TEST_CASE("a damaged or missing picture of the floor gives one clear error", "[sim][floor]") {
    const FloorFile file({0, 0, 0, 255, 0, 0});
    ArenaSpec arena;
    arena.floor = FloorSpec{.image = file.path.string(), .size = {3, 1}, .place = {"system.lua", 7}};
    const auto refusal = [&] {
        const auto world = make_world(arena, {}, {});
        return world ? "none" : describe(world.error());
    };
    CHECK(refusal() == "none");
    const std::string start = "system.lua:7: floor: '" + file.path.string() + "' can't be read as a PNG: ";
    fs::resize_file(file.path, fs::file_size(file.path) / 2);  // truncated
    CHECK(refusal().substr(0, start.size()) == start);
    std::ofstream(file.path) << "no picture";
    CHECK(refusal().substr(0, start.size()) == start);
    std::ofstream(file.path, std::ios::trunc).close();
    CHECK(refusal().substr(0, start.size()) == start);
    fs::remove(file.path);
    CHECK(refusal().substr(0, start.size()) == start);
}

TEST_CASE("a velocity constraint rolls an EV3 that coasts, and drags one whose motors hold", "[sim][ev3][disturb]") {
    const RobotSpec spec = ev3();
    for (const bool coasts : {true, false}) {
        TryWorld w;
        w.add(spec, 0, 0);
        if (coasts) {
            w.bodies[0]->coast();
        } else {
            w.bodies[0]->set_wheel_speeds({});
        }
        w.world->disturb(0, {.vx = 0.2, .va = 0.5});
        w.run(2);
        CHECK(w.truth().velocity.vx == Approx(0.2).epsilon(0.05));
        const Wheels turned = w.bodies[0]->wheel_angles();
        const double rolled = (turned.left + turned.right) / 2 * spec.drive.radius;
        const double swung = (turned.right - turned.left) * spec.drive.radius / spec.drive.track;
        CHECK(rolled == Approx(coasts ? 0.4 : 0).margin(0.01));
        CHECK(swung == Approx(coasts ? 1.0 : 0).margin(0.03));
    }
}

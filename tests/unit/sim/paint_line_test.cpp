// Lines on the floor, pixel by pixel, and as robots see them.
#include "sim/paint_line.hpp"

#include <algorithm>

#include "engine/world/floor_color.hpp"
#include "sim/floor_spot.hpp"
#include "tests/unit/sim/try_world.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

constexpr Rgb black = 0x1c1c1c;

Rgb at(const Picture& floor, const Point2D& size, double x, double y) {
    const int column = static_cast<int>((x / size.x + 0.5) * floor.width);
    const int row = static_cast<int>((0.5 - y / size.y) * floor.height);
    return floor.pixels[static_cast<std::size_t>(row * floor.width + column)];
}

}  // namespace

TEST_CASE("a line has its width, its colour and round ends, and changes nothing else", "[sim][floor]") {
    const Point2D size{1, 0.5};
    Picture floor = plain_floor(size);
    CHECK(floor.width == 1000);
    CHECK(floor.height == 500);
    const Rgb plain = floor.pixels[0];
    paint_line(floor, size, {.points = {{-0.2, 0.1}, {0.3, 0.1}}, .width = 0.02, .place = {}});
    for (const double x : {-0.2, 0.0, 0.3}) {
        CAPTURE(x);
        CHECK(at(floor, size, x, 0.1085) == black);
        CHECK(at(floor, size, x, 0.0915) == black);
        CHECK(at(floor, size, x, 0.1125) == plain);
        CHECK(at(floor, size, x, 0.0875) == plain);
    }
    CHECK(at(floor, size, 0.3085, 0.1) == black);  // the end is round
    CHECK(at(floor, size, 0.3085, 0.1085) == plain);
    CHECK(at(floor, size, 0.3125, 0.1) == plain);
    const auto painted = std::count(floor.pixels.begin(), floor.pixels.end(), black);
    CHECK(static_cast<double>(painted) * 1e-6 == Approx(0.5 * 0.02 + M_PI * 0.01 * 0.01).epsilon(0.1));
}

TEST_CASE("a line keeps its width on a picture whose pixels are not square", "[sim][floor]") {
    const Point2D size{1, 1};
    Picture floor{100, 1000, std::vector<Rgb>(100'000, 0xffffff)};
    paint_line(floor, size, {.points = {{-0.4, 0}, {0.4, 0}}, .width = 0.1, .color = "#ff0000", .place = {}});
    paint_line(floor, size, {.points = {{0, -0.4}, {0, 0.4}}, .width = 0.1, .color = "#ff0000", .place = {}});
    CHECK(at(floor, size, 0.2, 0.045) == 0xff0000);
    CHECK(at(floor, size, 0.2, 0.055) == 0xffffff);
    CHECK(at(floor, size, 0.035, 0.2) == 0xff0000);
    CHECK(at(floor, size, 0.075, 0.2) == 0xffffff);
}

TEST_CASE("a large floor has larger pixels", "[sim][floor]") {
    const Picture floor = plain_floor({20, 10});
    CHECK(floor.pixels.size() < 4'100'000);
    CHECK(floor.width == 2 * floor.height);
}

TEST_CASE("a sensor that looks down sees a line on a plain floor", "[sim][floor]") {
    RobotSpec spec = mouse_spec();
    SensorSpec below;
    below.name = "below";
    below.kind = SensorSpec::Kind::reflect;
    below.at = {0.04, 0, 0.01};
    spec.sensors.push_back(below);
    ArenaSpec arena;
    arena.size = Point2D{2, 2};
    arena.lines.push_back({.points = {{0.5, -0.5}, {0.5, 0.5}}, .width = 0.03, .place = {}});
    TryWorld world(arena);
    world.add(spec, 0, 0);
    world.run(0.1);
    const double plain = world.bodies[0]->reflected_light(4);
    CHECK(plain > 50);
    REQUIRE(world.world->teleport(0, {{0.46, 0}, 0}));
    world.run(0.1);
    CHECK(world.bodies[0]->reflected_light(4) < 20);
}

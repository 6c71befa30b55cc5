// Lines in pictures: detection, position and angle; then the component.
#include "engine/vision/line_detector.hpp"

#include <cmath>
#include <tuple>

#include "tests/unit/source_root.hpp"
#include "tests/unit/vision/seen.hpp"

using namespace nezumi;

namespace {

constexpr Color floor_of_room{210, 210, 210}, black{20, 20, 20}, white{250, 250, 250};

// A line 9 px wide through (x, y) with this angle [rad], 0 vertical and positive to the left.
Canvas with_line(double x, double y, double angle, Color line = black, Color ground = floor_of_room) {
    Canvas canvas(160, 120, ground);
    canvas.paint_where(line, [&](int column, int row) {
        // Across the line: its own direction is (-sin, -cos) to the right and down.
        return std::abs((column - x) * std::cos(angle) - (row - y) * std::sin(angle)) < 4.5;
    });
    return canvas;
}

std::optional<Blob> line_in(const Canvas& canvas, const LineSettings& settings = {}) {
    return find_line(canvas.grays(), settings);
}

struct LineWatch : Watched<LineDetector> {
    using Watched::Watched;
    double offset() { return value<double>("offset"); }
    double angle() { return value<double>("angle"); }
};

// A floor seen by a camera 0.1 m above the origin, with the line that an EV3 follows.
ArenaSpec floor_with_line() {
    ArenaSpec arena;
    arena.floor = FloorSpec{.image = source_root() + "/behaviors/line.png", .size = {1.6, 1.2}};
    return arena;
}

}  // namespace

TEST_CASE("a vertical line has an offset and angle 0", "[vision][line]") {
    const auto line = line_in(with_line(50, 60, 0));
    REQUIRE(line);
    CHECK(line->x == Approx(50).margin(0.01));
    CHECK(line->y == Approx(89.5).margin(0.01));  // the middle of the lower half
    CHECK(line->angle == Approx(0).margin(1e-9));
    CHECK(line->area == Approx(9 * 60).margin(0.1));
}

TEST_CASE("a horizontal line has an angle to the side", "[vision][line]") {
    const auto line = line_in(with_line(80, 90, M_PI / 2));
    REQUIRE(line);
    CHECK(line->x == Approx(79.5).margin(0.01));
    CHECK(line->y == Approx(90).margin(0.01));
    CHECK(std::abs(line->angle) == Approx(M_PI / 2));
}

TEST_CASE("a line that leans to the left has a positive angle", "[vision][line]") {
    for (const double angle : {-1.0, -0.6, -0.2, 0.2, 0.6, 1.0}) {
        INFO(angle);
        const auto line = line_in(with_line(80, 90, angle));
        REQUIRE(line);
        CHECK(line->x == Approx(80).margin(1));
        CHECK(line->angle == Approx(angle).margin(0.05));  // its ends are cut horizontally
    }
}

TEST_CASE("only the part of the picture below the parameter top is used", "[vision][line]") {
    Canvas canvas = with_line(50, 60, 0);
    canvas.paint(0, 0, 160, 55, white).paint(100, 0, 30, 55, black);
    CHECK(line_in(canvas)->x == Approx(50).margin(0.01));
    CHECK(line_in(canvas, {.top = 0})->x == Approx(114.5).margin(0.1));
    CHECK(line_in(canvas, {.top = 0.75})->y == Approx(104.5).margin(0.01));
    CHECK(line_in(canvas, {.top = 1})->y == Approx(119).margin(0.01));
}

TEST_CASE("a light line on a dark floor is found if light lines are requested", "[vision][line]") {
    const Canvas canvas = with_line(50, 60, 0, white, {60, 60, 60});
    const auto line = line_in(canvas, {.dark = false});
    REQUIRE(line);
    CHECK(line->x == Approx(50).margin(0.01));
    const auto floor_left_and_right = line_in(canvas);
    REQUIRE(floor_left_and_right);
    CHECK(floor_left_and_right->x > 100);
}

TEST_CASE("of two lines the larger one counts", "[vision][line]") {
    Canvas canvas = with_line(50, 60, 0);
    canvas.paint(100, 0, 20, 120, black);
    CHECK(line_in(canvas)->x == Approx(109.5).margin(0.01));
}

TEST_CASE("a line at the picture's edge is found there", "[vision][line]") {
    CHECK(line_in(with_line(0, 60, 0))->x == Approx(2).margin(0.2));
    CHECK(line_in(with_line(159, 60, 0))->x == Approx(157).margin(0.2));
    CHECK_FALSE(line_in(with_line(170, 60, 0)));
}

TEST_CASE("no line is found on an empty floor of any brightness", "[vision][line]") {
    for (const int gray : {0, 1, 127, 254, 255}) {
        const auto shade = static_cast<std::uint8_t>(gray);
        const Canvas canvas(160, 120, {shade, shade, shade});
        CHECK_FALSE(line_in(canvas));
        CHECK_FALSE(line_in(canvas, {.dark = false}));
        CHECK_FALSE(line_in(canvas, {.contrast = 0}));
        CHECK_FALSE(line_in(canvas, {.dark = false, .contrast = 0}));
    }
    CHECK_FALSE(line_in(Canvas(1, 1, black)));
}

TEST_CASE("an area with less than the required contrast is not a line", "[vision][line]") {
    const Canvas canvas = with_line(50, 60, 0, {150, 150, 150});
    CHECK_FALSE(line_in(canvas));
    CHECK(line_in(canvas, {.contrast = 0.15}));
    CHECK_FALSE(line_in(canvas, {.contrast = 0.24}));
}

TEST_CASE("a camera that looks down sees the line of a floor, left of it or right of it", "[vision][line]") {
    const auto seen = [](double y, double yaw, const ParameterValues& optics = {}) {
        const auto world = world_with(floor_with_line());
        CameraSettings settings{.width = 320, .height = 240, .field_of_view = field_of_view};
        if (!optics.empty()) {
            settings.noise = optics.at("noise").get<double>();
            settings.blur = optics.at("blur").get<double>();
        }
        const auto line =
            find_line(*to_gray(picture_of(*world, settings, {.at = {0, y, 0.1}, .yaw = yaw, .pitch = 0.8})), {});
        REQUIRE(line);
        return std::pair{from_middle(line->x, 320), line->angle};
    };
    // The line's lower side runs along y = -0.35.
    const auto [middle, ahead] = seen(-0.35, 0);
    CHECK(middle == Approx(0).margin(0.1));
    CHECK(ahead == Approx(0).margin(0.1));
    CHECK(seen(-0.37, 0).first > 0.15);
    CHECK(seen(-0.33, 0).first < -0.15);
    // If the camera looks to the right of the line's direction, the line goes to the left.
    CHECK(seen(-0.35, -0.4).second > 0.2);
    CHECK(seen(-0.35, 0.4).second < -0.2);
    const auto [noisy, noisy_angle] = seen(-0.37, 0.1, {{"noise", 13.0}, {"blur", 1.5}});
    const auto [clean, clean_angle] = seen(-0.37, 0.1);
    CHECK(noisy == Approx(clean).margin(0.02));
    CHECK(noisy_angle == Approx(clean_angle).margin(0.03));
}

TEST_CASE("noise alone is not a line", "[vision][line]") {
    LineWatch watch(ArenaSpec{}, {}, {{"noise", 13.0}, {"pitch", 0.8}});
    watch.run(100);
    CHECK(watch.port("visible").count() > 20);
    CHECK(watch.port("offset").count() == 0);
}

TEST_CASE("a line is published once per picture, and without a line only visible is published", "[vision][line]") {
    LineWatch watch(ArenaSpec{}, {}, {}, false);
    const auto look_at = [&](const Canvas& canvas) {
        watch.show(canvas.image());
        watch.run(5);
        return watch.visible();
    };
    CHECK(look_at(with_line(39.5, 60, 0)));
    CHECK(watch.offset() == Approx(0.5).margin(0.001));
    CHECK(watch.angle() == Approx(0).margin(1e-9));
    CHECK_FALSE(look_at(Canvas(160, 120, floor_of_room)));
    CHECK(watch.port("visible").count() == 2);
    CHECK(watch.port("offset").count() == 1);
    CHECK(watch.port("angle").count() == 1);
    CHECK(look_at(with_line(119.5, 60, -0.5)));
    CHECK(watch.offset() < -0.2);
    CHECK(watch.angle() == Approx(-0.5).margin(0.05));
    REQUIRE(watch.detector().parameters().set("least_area", 0.2));
    CHECK_FALSE(look_at(with_line(39.5, 60, 0)));
    REQUIRE(watch.detector().parameters().set("least_area", 0.005));
    REQUIRE(watch.detector().parameters().set("dark", false));
    CHECK(look_at(with_line(39.5, 60, 0, white, black)));
    CHECK(watch.offset() == Approx(0.5).margin(0.001));
    CHECK(watch.said.empty());
}

TEST_CASE("a detector of lines reports a torn picture too", "[vision][line]") {
    LineWatch watch(ArenaSpec{}, {}, {}, false);
    CameraImage torn = with_line(50, 60, 0).image();
    torn.pixels.resize(1000);
    watch.show(torn);
    watch.run(5);
    CHECK_FALSE(watch.visible());
    CHECK(watch.said == std::vector<std::string>{
                            "image: 160 x 120 pixels of rgb8 need 57600 bytes, got 1000: the picture is not searched"});
}

TEST_CASE("the parameters of a detector of lines are taken within their bounds and refused beyond", "[vision][line]") {
    LineWatch watch(ArenaSpec{});
    check_bounds(watch.detector(), "contrast", 0, 1);
    check_bounds(watch.detector(), "top", 0, 0.95);
    check_bounds(watch.detector(), "least_area", 0, 1);
    check_bounds(watch.detector(), "latency", 0, 10);
}

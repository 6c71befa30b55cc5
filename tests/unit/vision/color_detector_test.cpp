// Colours in pictures: pixels, objects and positions; then the component.
#include "engine/vision/color_detector.hpp"

#include <chrono>
#include <thread>
#include <tuple>

#include "tests/unit/vision/seen.hpp"

using namespace nezumi;

namespace {

constexpr Color ground{200, 200, 200}, red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255};

// Saturated, bright colours.
ColorRange hues(double from, double to) {
    return {.hue_from = from, .hue_to = to, .saturation_from = 0.5, .value_from = 0.5};
}

// True if a picture with only this colour has pixels in the range.
bool has(Color color, const ColorRange& range) { return find_color(Canvas(8, 8, color).colors(), range).has_value(); }

struct ColorWatch : Watched<ColorDetector> {
    using Watched::Watched;
    double left() { return value<std::vector<double>>("centre").at(0); }
    double up() { return value<std::vector<double>>("centre").at(1); }
    double area() { return value<double>("area"); }
};

ArenaSpec one_box(Point3D at = {0.5, 0, 0.1}, const char* color = "#d6453d") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = at, .size = {0.06, 0.06, 0.06}, .color = color});
    return arena;
}

}  // namespace

TEST_CASE("a coloured object has a centre and an area", "[vision][color]") {
    const auto blob = find_color(Canvas(100, 80, ground).paint(20, 10, 20, 30, red).colors(), hues(340, 20));
    REQUIRE(blob);
    CHECK(blob->x == Approx(29.5).margin(0.01));
    CHECK(blob->y == Approx(24.5).margin(0.01));
    CHECK(blob->area == Approx(600).margin(4));
}

TEST_CASE("each hue is in its place on the colour circle", "[vision][color]") {
    const std::pair<Color, double> circle[] = {{red, 0},    {{255, 255, 0}, 60}, {green, 120}, {{0, 255, 255}, 180},
                                               {blue, 240}, {{255, 0, 255}, 300}};
    for (const auto& [color, hue] : circle) {
        for (const auto& [other, at] : circle) {
            INFO(hue << " and " << at);
            CHECK(has(color, hues(at < 5 ? 355 : at - 5, at + 5)) == (hue == at));
        }
    }
}

TEST_CASE("a range of hues whose end is below its beginning goes through red", "[vision][color]") {
    constexpr Color crimson{255, 0, 42}, scarlet{255, 42, 0};  // 350 and 10 degrees
    for (const Color each : {crimson, red, scarlet}) {
        CHECK(has(each, hues(340, 20)));
        CHECK_FALSE(has(each, hues(20, 340)));
        CHECK(has(each, hues(0, 360)));
    }
    CHECK(has(crimson, hues(340, 355)));
    CHECK_FALSE(has(scarlet, hues(340, 355)));
    CHECK(has(scarlet, hues(5, 20)));
    CHECK_FALSE(has(crimson, hues(5, 20)));
    CHECK_FALSE(has(green, hues(340, 20)));
    CHECK(has(green, hues(20, 340)));
    // 0 and 360 are the same hue.
    CHECK(has(red, hues(340, 360)));
    CHECK(has(red, hues(0, 20)));
    CHECK(has(red, hues(360, 20)));
    CHECK(has(red, hues(360, 360)));
    CHECK(has(red, hues(0, 0)));
    CHECK_FALSE(has(green, hues(360, 20)));
    // Two halves of an object on both sides of red are one object.
    const auto both = find_color(
        Canvas(100, 80, ground).paint(20, 10, 20, 20, crimson).paint(40, 10, 20, 20, scarlet).colors(), hues(340, 20));
    REQUIRE(both);
    CHECK(both->x == Approx(39.5).margin(0.1));
    CHECK(both->area == Approx(800).margin(12));
}

TEST_CASE("saturation and value include both of their bounds", "[vision][color]") {
    constexpr Color pale{255, 153, 153}, dark{102, 0, 0};  // saturation 0.4; value 0.4
    CHECK(has(pale, {.saturation_from = 0.4}));
    CHECK(has(pale, {.saturation_to = 0.4}));
    CHECK_FALSE(has(pale, {.saturation_from = 0.41}));
    CHECK_FALSE(has(pale, {.saturation_to = 0.39}));
    CHECK(has(dark, {.value_from = 0.4}));
    CHECK(has(dark, {.value_to = 0.4}));
    CHECK_FALSE(has(dark, {.value_from = 0.41}));
    CHECK_FALSE(has(dark, {.value_to = 0.39}));
    CHECK(has(ground, {.saturation_to = 0, .value_to = 0.8}));
}

TEST_CASE("the largest object is reported, even among many small ones", "[vision][color]") {
    Canvas canvas(200, 100, ground);
    canvas.paint(20, 20, 20, 20, red).paint(120, 50, 24, 24, red).paint(60, 10, 40, 40, blue);
    for (int i = 0; i < 10; ++i) canvas.paint(10 + 18 * i, 90, 8, 8, red);
    const auto blob = find_color(canvas.colors(), hues(340, 20));
    REQUIRE(blob);
    CHECK(blob->x == Approx(131.5).margin(0.01));
    CHECK(blob->y == Approx(61.5).margin(0.01));
}

TEST_CASE("of an object at the picture's edge only the visible part counts", "[vision][color]") {
    for (const auto& [left, top, x, y] : {std::tuple{-10, 40, 4.5, 49.5},
                                          {90, 40, 94.5, 49.5},
                                          {40, -10, 49.5, 4.5},
                                          {40, 90, 49.5, 94.5},
                                          {90, 90, 94.5, 94.5}}) {
        const auto blob = find_color(Canvas(100, 100, ground).paint(left, top, 20, 20, red).colors(), hues(340, 20));
        REQUIRE(blob);
        CHECK(blob->x == Approx(x).margin(0.2));
        CHECK(blob->y == Approx(y).margin(0.2));
    }
    const auto all = find_color(Canvas(100, 80, red).colors(), hues(340, 20));
    REQUIRE(all);
    CHECK(all->x == 49.5);
    CHECK(all->y == 39.5);
    CHECK(all->area == 8000);
}

TEST_CASE("nothing is found if no object has the colour", "[vision][color]") {
    CHECK_FALSE(find_color(Canvas(100, 80, ground).paint(20, 10, 20, 20, blue).colors(), hues(340, 20)));
    CHECK_FALSE(find_color(Canvas(1, 1, ground).colors(), hues(340, 20)));
    CHECK_FALSE(find_color(Canvas(100, 80, red).colors(), {.saturation_from = 1, .saturation_to = 0}));
}

TEST_CASE("a box straight ahead is in the middle of the picture and as large as its face", "[vision][color]") {
    ColorWatch watch(one_box());
    watch.run(20);
    REQUIRE(watch.visible());
    CHECK(watch.left() == Approx(0).margin(0.005));
    CHECK(watch.up() == Approx(0).margin(0.005));
    const double edge = 0.06 / 0.47 / (2 * std::tan(field_of_view / 2));  // in widths of the picture
    CHECK(watch.area() == Approx(edge * edge * 640 / 480).epsilon(0.05));
}

TEST_CASE("left and up are positive, as in the robot's axes", "[vision][color]") {
    const auto seen = [](double y, double z) {
        ColorWatch watch(one_box({0.5, y, 0.1 + z}));
        watch.run(20);
        REQUIRE(watch.visible());
        return std::pair{watch.left(), watch.up()};
    };
    const auto [left, level] = seen(0.15, 0);
    CHECK(left > 0.4);
    CHECK(left < 0.66);
    CHECK(level == Approx(0).margin(0.01));
    CHECK(seen(-0.15, 0).first == Approx(-left).margin(0.01));
    CHECK(seen(0, 0.1).second > 0.3);
    CHECK(seen(0, -0.06).second < -0.2);
}

TEST_CASE("a noisy and blurred picture gives nearly the same result as a clean one", "[vision][color]") {
    const auto seen = [](const ParameterValues& camera) {
        ColorWatch watch(one_box({0.6, 0.1, 0.1}), {}, camera);
        watch.run(20);
        REQUIRE(watch.visible());
        return std::tuple{watch.left(), watch.up(), watch.area()};
    };
    const auto [left, up, area] = seen({});
    const auto [noisy_left, noisy_up, noisy_area] = seen({{"noise", 13.0}, {"blur", 1.5}});
    CHECK(noisy_left == Approx(left).margin(0.01));
    CHECK(noisy_up == Approx(up).margin(0.01));
    CHECK(noisy_area == Approx(area).epsilon(0.1));
}

TEST_CASE("noise alone is not an object", "[vision][color]") {
    ColorWatch watch({}, {}, {{"noise", 13.0}});
    watch.run(100);
    CHECK(watch.port("visible").count() > 20);
    CHECK(watch.port("centre").count() == 0);
}

TEST_CASE("without an object only visible is published, once per picture", "[vision][color]") {
    ColorWatch watch(one_box({0.5, 0, 0.1}, "#3568c4"));
    watch.run(50);
    CHECK_FALSE(watch.visible());
    CHECK(watch.port("visible").count() > 10);
    CHECK(watch.port("centre").count() == 0);
    CHECK(watch.port("area").count() == 0);
    REQUIRE(watch.detector().parameters().set_all({{"hue_from", 200.0}, {"hue_to", 240.0}}));
    watch.run(20);
    CHECK(watch.visible());
    CHECK(watch.port("centre").count() == watch.port("area").count());
    CHECK(watch.said.empty());
}

TEST_CASE("an object smaller than the least area is ignored", "[vision][color]") {
    ColorWatch watch({}, {{"least_area", 0.05}}, {}, false);
    watch.show(Canvas(100, 100, ground).paint(20, 20, 20, 20, red).image());
    watch.run(5);
    CHECK_FALSE(watch.visible());
    watch.show(Canvas(100, 100, ground).paint(20, 20, 30, 30, red).image());
    watch.run(5);
    CHECK(watch.visible());
    CHECK(watch.area() == Approx(0.09).margin(0.001));
    CHECK(watch.left() == Approx(0.3).margin(0.001));
    CHECK(watch.up() == Approx(0.3).margin(0.001));
}

TEST_CASE("a range that contains no colour is reported once until it contains one", "[vision][color]") {
    ColorWatch watch(one_box(), {{"saturation_from", 0.9}, {"saturation_to", 0.25}});
    watch.run(50);
    CHECK_FALSE(watch.visible());
    REQUIRE(watch.detector().parameters().set("saturation_to", 1.0));
    REQUIRE(watch.detector().parameters().set("saturation_from", 0.4));
    watch.run(20);
    CHECK(watch.visible());
    REQUIRE(watch.detector().parameters().set("value_from", 1.0));
    REQUIRE(watch.detector().parameters().set("value_to", 0.5));
    watch.run(20);
    CHECK_FALSE(watch.visible());
    CHECK(watch.said ==
          std::vector<std::string>{"an empty range, as saturation_from = 0.9 is above saturation_to = 0.25: the "
                                   "picture is not searched",
                                   "an empty range, as value_from = 1 is above value_to = 0.5: the picture is not "
                                   "searched"});
}

TEST_CASE("a grey picture is reported once and not used", "[vision][color]") {
    ColorWatch watch(one_box(), {}, {{"format", std::string("gray8")}});
    watch.run(50);
    CHECK_FALSE(watch.visible());
    CHECK(watch.port("visible").count() > 10);
    CHECK(watch.said ==
          std::vector<std::string>{"image: gray8 has no colours: expected rgb8 or bgr8: the picture is not searched"});
}

TEST_CASE("a detector publishes its result after the latency, and then continues with the newest picture",
          "[vision][color]") {
    ColorWatch watch({}, {{"latency", 0.05}}, {}, false);
    const auto shown = [](int left) { return Canvas(100, 100, ground).paint(left, 40, 20, 20, red).image(); };
    watch.show(shown(0));
    watch.run(1);
    watch.show(shown(20));
    watch.run(1);
    watch.show(shown(40));
    watch.run(3);
    CHECK(watch.port("centre").count() == 0);
    watch.run(1);
    CHECK(watch.port("centre").count() == 1);
    CHECK(watch.left() == Approx(0.8).margin(0.01));
    watch.run(10);  // the second one was skipped
    CHECK(watch.port("centre").count() == 2);
    CHECK(watch.left() == Approx(0).margin(0.01));
}

TEST_CASE("on hardware a colour is published as soon as it is known, without the latency", "[vision][color]") {
    ColorDetector detector("detector", false);
    REQUIRE(detector.parameters().set("latency", 10.0));
    const Time now{.tick = 1, .seconds = 0.01};
    REQUIRE(detector.activate(now));
    detector.find_in_port("image")->inject(Canvas(100, 100, ground).paint(20, 20, 20, 20, red).image());
    const auto& visible = *detector.find_out_port("visible");
    for (int i = 0; i < 10000 && visible.count() == 0; ++i) {
        detector.latch_inputs(now);
        detector.execute(now);
        detector.latch_outputs(now);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(visible.count() == 1);
    CHECK(visible.value().get<bool>());
}

TEST_CASE("the same run of a detector of colours has the same trace, also with noise", "[vision][color]") {
    const auto trace = [](double noise) {
        ColorWatch watch(one_box({0.5, 0.1, 0.1}), {}, {{"noise", noise}});
        watch.run(60);
        return watch.hash.value();
    };
    CHECK(trace(5) == trace(5));
    CHECK(trace(5) != trace(6));
}

TEST_CASE("the parameters of a detector of colours are taken within their bounds and refused beyond",
          "[vision][color]") {
    ColorWatch watch(ArenaSpec{});
    for (const char* hue : {"hue_from", "hue_to"}) check_bounds(watch.detector(), hue, 0, 360);
    for (const char* share : {"saturation_from", "saturation_to", "value_from", "value_to", "least_area"})
        check_bounds(watch.detector(), share, 0, 1);
    check_bounds(watch.detector(), "latency", 0, 10);
}

// Downward-looking sensors: places on the picture, colours, brightness.
#include <catch2/catch.hpp>

#include <limits>

#include "sim/floor_spot.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

// Red, green / blue, white.
const Picture four{2, 2, {0xff0000, 0x00ff00, 0x0000ff, 0xffffff}};

}  // namespace

TEST_CASE("the floor's picture lies with its top where y is largest", "[sim][floor]") {
    const Point2D size{2, 1};
    CHECK(floor_spot_color(four, size, {-0.5, 0.25}) == 0xff0000u);
    CHECK(floor_spot_color(four, size, {0.5, 0.25}) == 0x00ff00u);
    CHECK(floor_spot_color(four, size, {-0.5, -0.25}) == 0x0000ffu);
    CHECK(floor_spot_color(four, size, {0.5, -0.25}) == 0xffffffu);
}

TEST_CASE("outside the floor's picture no colour is seen", "[sim][floor]") {
    const Point2D size{2, 1};
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Point2D& at : {Point2D{1.01, 0}, {-1.01, 0}, {0, 0.51}, {0, -0.51}, {1e300, 0}, {nan, 0}, {0, nan}}) {
        CHECK_FALSE(floor_spot_color(four, size, at).has_value());
    }
    CHECK(floor_spot_color(four, size, {0.999, 0.499}) == 0x00ff00u);  // half of the spot is outside
}

TEST_CASE("a spot on an edge has the mean colour of both sides", "[sim][floor]") {
    const Picture line{2, 1, {0x000000, 0xffffff}};
    const double light = brightness(*floor_spot_color(line, {1, 1}, {0.0001, 0}));
    CHECK(light > 40);
    CHECK(light < 80);
    CHECK(brightness(*floor_spot_color(line, {1, 1}, {-0.0001, 0})) < light);
}

TEST_CASE("colours have the names that a colour sensor gives them", "[sim][floor]") {
    using enum FloorColor;
    for (const auto& [color, expected] : {std::pair{0x000000u, black},
                                          {0x1e1e1eu, black},
                                          {0x404040u, black},
                                          {0xffffffu, white},
                                          {0xc9c4bau, white},
                                          {0x0000ffu, blue},
                                          {0x000080u, blue},
                                          {0x4040c0u, blue},
                                          {0x00ffffu, blue},
                                          {0x00ff00u, green},
                                          {0x006400u, green},
                                          {0x32cd32u, green},
                                          {0xffff00u, yellow},
                                          {0xffd700u, yellow},
                                          {0xff0000u, red},
                                          {0x8b0000u, red},
                                          {0xdc143cu, red},
                                          {0x8b4513u, brown},
                                          {0xa52a2au, brown},
                                          {0x583927u, brown}}) {
        INFO(std::hex << color);
        CHECK(to_text(nearest_floor_color(color)) == to_text(expected));
    }
}

TEST_CASE("a fixed limit separates the names of two colours", "[sim][floor]") {
    using enum FloorColor;
    struct Limit {
        Rgb color;
        FloorColor expected;
        Rgb beyond;
        FloorColor expected_beyond;
    };
    for (const Limit& limit : {Limit{0x2c0000, black, 0x2d0000, red},   // least brightness of a colour
                               {0x6d6d6d, black, 0x6e6e6e, white},      // least brightness of white
                               {0xc8a1a1, white, 0xc8a0a0, red},        // least saturation of a colour
                               {0xff3200, red, 0xff3500, red},          // 12 degrees: bright, no limit
                               {0xb32300, red, 0xb32500, brown},        // dark, it is one
                               {0xff6800, red, 0xff6d00, yellow},       // 25
                               {0xb39300, brown, 0xb39700, yellow},     // 50
                               {0xd7ff00, yellow, 0xd1ff00, green},     // 70
                               {0x00ffd2, green, 0x00ffd7, blue},       // 170
                               {0xa800ff, blue, 0xac00ff, red},         // 280
                               {0xb34747, brown, 0xb32323, red},        // a dark red that is pure
                               {0xb32424, brown, 0xb42424, red},        // or not dark
                               {0xb36000, brown, 0xb46000, yellow}}) {  // a dark orange
        INFO(std::hex << limit.color << " and " << limit.beyond);
        CHECK(to_text(nearest_floor_color(limit.color)) == to_text(limit.expected));
        CHECK(to_text(nearest_floor_color(limit.beyond)) == to_text(limit.expected_beyond));
    }
}

TEST_CASE("brightness goes from 0 for black to 100 for white", "[sim][floor]") {
    CHECK(brightness(0x000000) == Approx(0).margin(1e-9));
    CHECK(brightness(0x808080) == Approx(50.2).epsilon(0.01));
    CHECK(brightness(0xffffff) == Approx(100));
}

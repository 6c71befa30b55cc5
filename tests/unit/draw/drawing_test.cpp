// Pictures and plots: odd contents draw as well as usual ones, and errors leave no file.
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>

#include "bindings/draw/canvas.hpp"
#include "bindings/draw/picture.hpp"
#include "bindings/draw/plot.hpp"
#include "sim/picture.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::draw;

namespace {

// Width and height as a PNG's header says them.
std::pair<int, int> size_of_png(const std::string& bytes) {
    const auto number = [&](std::size_t at) {
        int value = 0;
        for (std::size_t i = at; i < at + 4; ++i) value = value * 256 + static_cast<unsigned char>(bytes.at(i));
        return value;
    };
    return {number(16), number(20)};
}

}  // namespace

TEST_CASE("a picture's scale depends on its contents", "[draw][picture]") {
    const Scratch scratch;
    const std::string file = scratch.path("a.png").string();
    PictureOf picture{.title = "nothing"};
    REQUIRE(draw_picture(picture, file, sim::read_picture));
    const auto [width, height] = size_of_png(text_of_file(file));
    CHECK(width >= 560);
    CHECK(height >= 240);

    // A wall of 100 km, and a robot that has left the world of numbers.
    picture.things.push_back({.size = {1e5, 0.1, 0.1}, .color = "#ff0000"});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    picture.robots.push_back({.name = "lost", .pose = {{nan, nan}, nan}, .path = {{nan, 0}}});
    REQUIRE(draw_picture(picture, file, sim::read_picture));
    CHECK(size_of_png(text_of_file(file)).first < 2000);
    CHECK(size_of_png(text_of_file(file)).second < 2000);
}

TEST_CASE("a picture shows the floor's image, its top where y is largest", "[draw][picture]") {
    const Scratch scratch;
    // Two pixels, red over blue.
    const std::string image = scratch.path("floor.png").string();
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> floor(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 2), cairo_surface_destroy);
    unsigned char* const pixels = cairo_image_surface_get_data(floor.get());
    const int stride = cairo_image_surface_get_stride(floor.get());
    for (int i = 0; i < 4; ++i) pixels[i] = i == 2 ? 255 : 0, pixels[stride + i] = i == 0 ? 255 : 0;
    cairo_surface_mark_dirty(floor.get());
    REQUIRE(cairo_surface_write_to_png(floor.get(), image.c_str()) == CAIRO_STATUS_SUCCESS);

    const std::string file = scratch.path("a.png").string();
    REQUIRE(draw_picture({.title = "floor", .floor = FloorSpec{image, {1, 1}, {}}}, file, sim::read_picture));
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> drawn(
        cairo_image_surface_create_from_png(file.c_str()), cairo_surface_destroy);
    const int width = cairo_image_surface_get_width(drawn.get()), height = cairo_image_surface_get_height(drawn.get());
    const auto colour_at = [&](double x, double y) {
        const unsigned char* const pixel = cairo_image_surface_get_data(drawn.get()) +
                                           std::lround(y * height) * cairo_image_surface_get_stride(drawn.get()) +
                                           std::lround(x * width) * 4;
        return std::vector<int>{pixel[2], pixel[1], pixel[0]};
    };
    CHECK(colour_at(0.5, 0.3) == std::vector<int>{255, 0, 0});
    CHECK(colour_at(0.5, 0.7) == std::vector<int>{0, 0, 255});
}

TEST_CASE("a plot is drawn with any values", "[draw][plot]") {
    const Scratch scratch;
    const std::string file = scratch.path("a.svg").string();
    Plot plot{.title = "values"};
    REQUIRE(draw_plot(plot, file));
    const double infinity = std::numeric_limits<double>::infinity();
    plot.series = {
        {"mouse.ir_sensor_out[1]", {{0, 1}, {1, infinity}, {2, 3}}}, {"constant", {{0, 5}, {2, 5}}}, {"", {}}};
    plot.limits = {{"at most", 4}};
    plot.moments = {{"failed", 1.5}};
    REQUIRE(draw_plot(plot, file));
    const std::string svg = text_of_file(file);
    CHECK(svg.find("</svg>") != std::string::npos);
    CHECK(svg.find("nan") == std::string::npos);
    CHECK(svg.find("inf") == std::string::npos);
}

TEST_CASE("a write error is reported and leaves no file", "[draw][picture]") {
    const Scratch scratch;
    const std::string file = scratch.path("none/a.png").string();
    const auto drawn = draw_picture({.title = "x"}, file, sim::read_picture);
    REQUIRE_FALSE(drawn);
    CHECK(describe(drawn.error()) == file + ": can't be written: No such file or directory");
}

// Markers are printed to scale, and are found where they are.
#include <cairo.h>
#include <catch2/catch.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bindings/draw/marker_drawing.hpp"
#include "bindings/draw/marker_sheet.hpp"
#include "engine/vision/tag_finder.hpp"
#include "sim/picture.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::draw;

namespace {

constexpr double pixels_per_metre = 5000;  // 127 dpi

// The sheet as a printer would make it.
GrayImage printed(const Paper& paper, int id, double size) {
    const int width = static_cast<int>(paper.width * pixels_per_metre);
    const int height = static_cast<int>(paper.height * pixels_per_metre);
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
    const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> context(cairo_create(surface.get()), cairo_destroy);
    cairo_set_source_rgb(context.get(), 1, 1, 1);
    cairo_paint(context.get());
    cairo_scale(context.get(), pixels_per_metre, pixels_per_metre);
    draw_marker(context.get(), paper, {id, sim::paint_tag(id)}, size);
    cairo_surface_flush(surface.get());
    GrayImage image{width, height, {}};
    const unsigned char* row = cairo_image_surface_get_data(surface.get());
    for (int y = 0; y < height; ++y, row += cairo_image_surface_get_stride(surface.get())) {
        for (int x = 0; x < width; ++x) image.pixels.push_back(row[4 * x]);
    }
    return image;
}

}  // namespace

TEST_CASE("a printed marker is found with its number, and its black border has the requested length",
          "[draw][marker]") {
    const Paper& paper = papers().front();
    for (const double size : {0.03, 0.1, largest_marker(paper)}) {
        GrayImage image = printed(paper, 7, size);
        const CameraIntrinsics pinhole{.width = static_cast<std::uint16_t>(image.width),
                                       .height = static_cast<std::uint16_t>(image.height),
                                       .fx = 1000,
                                       .fy = 1000,
                                       .cx = image.width / 2.0,
                                       .cy = image.height / 2.0};
        const auto tags = TagFinder("36h11").find(image, pinhole, size);
        REQUIRE(tags.size() == 1);
        CHECK(tags[0].id == 7);
        CHECK(tags[0].edge == Approx(size * pixels_per_metre).margin(1));
    }
}

TEST_CASE("the PDF has a page of the paper's size for each marker", "[draw][marker]") {
    const Scratch files;
    const std::string pdf = files.path("tag.pdf").string();
    CHECK(run_with_output(files.write("out.pdf", "").string(), {"marker", "7", "--size", "0.1"}).status == 0);
    const std::string text = text_of_file(files.path("out.pdf"));
    CHECK(text.starts_with("%PDF-"));
    CHECK(text.find("/MediaBox [ 0 0 595.27") != std::string::npos);  // A4 [1/72 inch]
    CHECK(text.find("/Count 1") != std::string::npos);
    CHECK(run_nezumi({"marker", "7", "8", "9", "--paper", "letter", "-o", pdf}).status == 0);
    CHECK(text_of_file(pdf).find("/MediaBox [ 0 0 612 792") != std::string::npos);
    CHECK(text_of_file(pdf).find("/Count 3") != std::string::npos);
}

TEST_CASE("a marker that does not exist or does not fit is refused", "[draw][marker]") {
    const auto refused = [](std::vector<std::string> words) {
        words.insert(words.begin(), "marker");
        const Outcome outcome = run_nezumi(std::move(words));
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        return outcome.error;
    };
    CHECK(refused({"587"}) == "nezumi: marker: expected a whole number from 0 to 586, got '587'\n");
    CHECK(refused({"seven"}) == "nezumi: marker: expected a whole number from 0 to 586, got 'seven'\n");
    CHECK(refused({"7", "--size", "0.2"}) ==
          "nezumi: marker: 0.2 m does not fit on A4: the largest marker on it is 0.160 m\n");
    CHECK(refused({"7", "--size", "0"}) ==
          "nezumi: --size: expected a number from 0.005 to 1, got '0'; see nezumi marker --help\n");
    CHECK(refused({"7", "--paper", "A44"}) ==
          "nezumi: marker: there is no paper 'A44' (did you mean 'A4'?); known are A4, A5, A3, letter\n");
    CHECK(refused({}) == "nezumi: ID is missing; see nezumi marker --help\n");
}

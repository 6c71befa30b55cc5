// Memory that detectors allocate for a series of pictures.
#include "engine/vision/color_detector.hpp"
#include "engine/vision/line_detector.hpp"
#include "engine/vision/marker_detector.hpp"
#include "tests/unit/large_allocations.hpp"
#include "tests/unit/vision/seen.hpp"

using namespace nezumi;

namespace {

CameraImage picture(const std::string& format) {
    const int bytes = format == "gray8" ? 1 : 3;
    return {.width = 320,
            .height = 240,
            .bpp = static_cast<std::uint16_t>(8 * bytes),
            .format = format,
            .pixels = Octets(static_cast<std::size_t>(320 * 240 * bytes), 100)};
}

// Allocated by the ticking thread for some pictures after the first.
template <class Detector>
std::size_t allocations_for(const std::string& format) {
    Watched<Detector> watch({}, {}, {{"frame_rate", 0.01}}, false);
    std::size_t count = 0;
    for (int pictures = 0; pictures < 4; ++pictures) {
        watch.show(picture(format));
        const std::size_t before = large_allocations();
        watch.run(10);
        if (pictures > 0) count += large_allocations() - before;
        CHECK(watch.port("visible").count() == static_cast<std::uint64_t>(pictures) + 1);
    }
    CHECK(watch.said.empty());
    return count;
}

}  // namespace

TEST_CASE("pixels use the memory of an earlier picture", "[vision][image]") {
    for (const char* format : {"gray8", "rgb8", "bgr8"}) {
        INFO(format);
        const CameraImage image = picture(format);
        Octets memory(std::size_t{320} * 240 * 3);
        const std::uint8_t* const there = memory.data();
        auto gray = to_gray(image, std::move(memory));
        REQUIRE(gray);
        CHECK(gray->pixels.data() == there);
        CHECK(gray->pixels.size() == std::size_t{320} * 240);
        if (image.bpp == 8) continue;
        const auto colored = to_rgb(image, std::move(gray->pixels));
        REQUIRE(colored);
        CHECK(colored->pixels.data() == there);
    }
}

TEST_CASE("detectors use the same memory for each picture", "[vision][detector]") {
    for (const char* format : {"rgb8", "bgr8"}) {
        INFO(format);
        CHECK(allocations_for<ColorDetector>(format) == 0);
        CHECK(allocations_for<LineDetector>(format) == 0);
        CHECK(allocations_for<MarkerDetector>(format) == 0);
    }
    CHECK(allocations_for<LineDetector>("gray8") == 0);
    CHECK(allocations_for<MarkerDetector>("gray8") == 0);
}

// Invalid pictures and their errors.
#include <catch2/catch.hpp>

#include "engine/vision/checked_image.hpp"

using namespace nezumi;

namespace {

CameraImage image(int width, int height, int bpp, const char* format, std::size_t bytes) {
    return {.width = static_cast<std::uint16_t>(width),
            .height = static_cast<std::uint16_t>(height),
            .bpp = static_cast<std::uint16_t>(bpp),
            .format = format,
            .pixels = Octets(bytes, 100)};
}

std::string complaint(const CameraImage& image) {
    const auto gray = to_gray(image);
    REQUIRE_FALSE(gray);
    return gray.error().message;
}

}  // namespace

TEST_CASE("grey pictures pass, coloured ones become grey", "[vision][image]") {
    CHECK(to_gray(image(3, 2, 8, "gray8", 6))->pixels == Octets(6, 100));
    CHECK(to_gray(image(3, 2, 8, "mono8", 6))->pixels == Octets(6, 100));
    CHECK(to_gray(image(3, 2, 8, "", 6))->pixels == Octets(6, 100));
    CHECK(to_gray(image(3, 2, 24, "", 18))->pixels == Octets(6, 100));
    CameraImage red = image(1, 1, 24, "rgb8", 3);
    red.pixels = {255, 0, 0};
    CHECK(to_gray(red)->pixels == Octets{76});
    red.format = "bgr8";
    CHECK(to_gray(red)->pixels == Octets{29});
}

TEST_CASE("a picture whose sizes do not agree is refused in plain words", "[vision][image]") {
    CHECK(complaint({}) == "an empty picture (0 x 0, 0 bytes)");
    CHECK(complaint(image(0, 480, 24, "rgb8", 12)) == "an empty picture (0 x 480, 12 bytes)");
    CHECK(complaint(image(640, 480, 24, "rgb8", 12)) == "640 x 480 pixels of rgb8 need 921600 bytes, got 12");
    CHECK(complaint(image(2, 2, 24, "rgb8", 13)) == "2 x 2 pixels of rgb8 need 12 bytes, got 13");
    CHECK(complaint(image(65535, 65535, 24, "rgb8", 3)) ==
          "65535 x 65535 pixels of rgb8 need 12884508675 bytes, got 3");
    CHECK(complaint(image(2, 2, 16, "rgb8", 12)) == "format 'rgb8' has 24 bits a pixel, got bpp = 16");
    CHECK(complaint(image(2, 2, 16, "", 8)) == "no format, and a bpp of 16: expected 8 or 24");
    CHECK(complaint(image(2, 2, 24, "rgb", 12)) ==
          "unknown format 'rgb': expected gray8, mono8, rgb8 or bgr8 (did you mean 'rgb8'?)");
    CHECK(complaint(image(2, 2, 24, "jpeg", 12)) == "unknown format 'jpeg': expected gray8, mono8, rgb8 or bgr8");
}

TEST_CASE("coloured pictures come as red, green and blue", "[vision][image]") {
    CameraImage two = image(2, 1, 24, "rgb8", 6);
    two.pixels = {1, 2, 3, 4, 5, 6};
    CHECK(to_rgb(two)->pixels == Octets{1, 2, 3, 4, 5, 6});
    two.format = "";
    CHECK(to_rgb(two)->pixels == Octets{1, 2, 3, 4, 5, 6});
    two.format = "bgr8";
    CHECK(to_rgb(two)->pixels == Octets{3, 2, 1, 6, 5, 4});
    CHECK(to_rgb(two)->width == 2);
    CHECK(to_rgb(two)->height == 1);
}

TEST_CASE("a grey picture is refused if colours are needed, as is one whose sizes do not agree", "[vision][image]") {
    const auto refused = [](const CameraImage& wrong) {
        const auto colored = to_rgb(wrong);
        REQUIRE_FALSE(colored);
        return colored.error().message;
    };
    CHECK(refused(image(3, 2, 8, "mono8", 6)) == "mono8 has no colours: expected rgb8 or bgr8");
    CHECK(refused(image(3, 2, 8, "", 6)) == "gray8 has no colours: expected rgb8 or bgr8");
    CHECK(refused({}) == "an empty picture (0 x 0, 0 bytes)");
    CHECK(refused(image(2, 2, 24, "bgr8", 13)) == "2 x 2 pixels of bgr8 need 12 bytes, got 13");
}

// Invalid pictures and their errors.
#include <catch2/catch.hpp>

#include "engine/vision/checked_image.hpp"
#include "engine/world/picture.hpp"

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
    CHECK(complaint(image(2, 2, 16, "rgb8", 12)) == "format 'rgb8' has 24 bits per pixel, got bpp = 16");
    CHECK(complaint(image(2, 2, 16, "", 8)) == "a picture without a format must have a bpp of 8 or 24, got 16");
    const std::string known = "gray8, mono8, rgb8, bgr8, 8UC3, rgba8, bgra8, mono16, yuv422_yuy2, yuv422, jpeg, png";
    CHECK(complaint(image(2, 2, 24, "rgb", 12)) ==
          "unknown format 'rgb': expected " + known + " (did you mean 'rgb8'?)");
    CHECK(complaint(image(2, 2, 24, "h264", 12)) == "unknown format 'h264': expected " + known);
    CHECK(complaint(image(3, 2, 16, "yuv422_yuy2", 12)) == "3 pixels in a row of yuv422_yuy2: expected an even number");
    CHECK(complaint(image(2, 2, 24, "jpeg", 12)) ==
          "a jpeg that can't be read: OpenCV can't read its format (PNG, JPEG, BMP, TIFF, WebP, PPM and others are "
          "possible)");
}

TEST_CASE("colour images are converted to red, green, blue", "[vision][image]") {
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

TEST_CASE("pictures as ROS's cameras send them are taken, by their colours and in grey", "[vision][image]") {
    CameraImage one = image(1, 1, 32, "bgra8", 4);
    one.pixels = {0, 0, 255, 9};  // red
    CHECK(to_rgb(one)->pixels == Octets{255, 0, 0});
    CHECK(to_gray(one)->pixels == Octets{76});
    one.format = "rgba8";
    CHECK(to_rgb(one)->pixels == Octets{0, 0, 255});
    CameraImage blue = image(1, 1, 24, "8UC3", 3);
    blue.pixels = {255, 0, 0};
    CHECK(to_rgb(blue)->pixels == Octets{0, 0, 255});
    CameraImage deep = image(2, 1, 16, "mono16", 4);
    deep.pixels = {0, 0, 0xff, 0xff};
    CHECK(to_gray(deep)->pixels == Octets{0, 255});
    CameraImage yuv = image(2, 1, 16, "yuv422_yuy2", 4);
    yuv.pixels = {235, 128, 16, 128};  // white, black
    CHECK(to_rgb(yuv)->pixels == Octets{255, 255, 255, 0, 0, 0});
    CHECK(to_gray(yuv)->pixels == Octets{235, 16});
    yuv.format = "yuv422";
    yuv.pixels = {128, 235, 128, 16};
    CHECK(to_rgb(yuv)->pixels == Octets{255, 255, 255, 0, 0, 0});
    // A PNG of one green pixel.
    const CameraImage compressed{
        .format = "png", .pixels = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
                                    0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
                                    0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
                                    0x9c, 0x63, 0x60, 0xf8, 0xcf, 0x00, 0x00, 0x02, 0x02, 0x01, 0x00, 0x7b, 0x09, 0x81,
                                    0x78, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82}};
    const auto decoded = to_rgb(compressed);
    INFO((decoded ? std::string() : decoded.error().message));
    REQUIRE(decoded.has_value());
    CHECK(decoded->pixels == Octets{0, 255, 0});
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

TEST_CASE("pictures of all formats become JPEG, and one that is JPEG stays as it is", "[vision][image]") {
    const auto color_of = [](const CameraImage& picture) {
        const auto jpeg = to_jpeg(picture);
        INFO((jpeg ? std::string() : jpeg.error().message));
        REQUIRE(jpeg.has_value());
        CHECK(jpeg->width == 8);
        CHECK(jpeg->height == 8);
        const auto shown = decode_picture({reinterpret_cast<const char*>(jpeg->bytes.data()), jpeg->bytes.size()});
        REQUIRE(shown.has_value());
        const Rgb middle = shown->pixels[4 * 8 + 4];
        // JPEG changes colours a little.
        return std::array{(middle >> 16 & 0xff) / 64, (middle >> 8 & 0xff) / 64, (middle & 0xff) / 64};
    };
    const auto filled = [](const char* format, const Octets& pixel) {
        CameraImage all = image(8, 8, static_cast<int>(8 * pixel.size()), format, 0);
        for (int i = 0; i < 64; ++i) all.pixels.insert(all.pixels.end(), pixel.begin(), pixel.end());
        return all;
    };
    using Color = std::array<Rgb, 3>;
    CHECK(color_of(filled("rgb8", {255, 0, 0})) == Color{3, 0, 0});
    CHECK(color_of(filled("bgr8", {255, 0, 0})) == Color{0, 0, 3});
    CHECK(color_of(filled("bgra8", {0, 255, 0, 9})) == Color{0, 3, 0});
    CHECK(color_of(filled("mono16", {0, 160})) == Color{2, 2, 2});
    CHECK(color_of(filled("yuv422_yuy2", {235, 128})) == Color{3, 3, 3});
    const CameraImage compressed{.format = "jpeg", .pixels = to_jpeg(filled("mono8", {96}))->bytes};
    CHECK(color_of(compressed) == Color{1, 1, 1});
    CHECK(to_jpeg(compressed)->bytes == compressed.pixels);
    CHECK(to_jpeg(image(2, 2, 24, "bgr8", 13)).error().message == "2 x 2 pixels of bgr8 need 12 bytes, got 13");
}

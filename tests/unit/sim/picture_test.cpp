// Pictures of floors in the formats that people have.
#include "sim/picture.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

// Two by two: red and green above, blue and white below.
const std::vector<Rgb> colours{0xff0000, 0x00ff00, 0x0000ff, 0xffffff};

std::string little(std::uint32_t number, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> (8 * i) & 0xff);
    return text;
}

// A bitmap has its rows from below, each in blue, green, red, to a multiple of 4 bytes.
std::string bitmap() {
    std::string pixels;
    for (const std::size_t row : {std::size_t{1}, std::size_t{0}}) {
        for (std::size_t column = 0; column < 2; ++column) pixels += little(colours[2 * row + column], 3);
        pixels += little(0, 2);
    }
    return "BM" + little(54 + 16, 4) + little(0, 4) + little(54, 4) + little(40, 4) + little(2, 4) + little(2, 4) +
           little(1, 2) + little(24, 2) + little(0, 4) + little(16, 4) + std::string(16, '\0') + pixels;
}

std::string portable(int white) {
    std::string text = "P6\n2 2\n" + std::to_string(white) + "\n";
    for (const Rgb colour : colours) {
        for (const int shift : {16, 8, 0}) {
            const char part = static_cast<char>(colour >> shift & 0xff);
            text += part;
            if (white > 255) text += part;  // 16 bits
        }
    }
    return text;
}

std::string refusal(const std::string& file) {
    const auto picture = read_picture(file);
    return picture ? "none" : picture.error().message;
}

}  // namespace

TEST_CASE("a floor's picture may have any common format and any file name", "[sim][floor]") {
    const Scratch scratch;
    const std::string files[] = {
        scratch.write("floor.bmp", bitmap()).string(), scratch.write("floor.ppm", portable(255)).string(),
        scratch.write("deep.ppm", portable(65535)).string(), scratch.write("no_ending", bitmap()).string()};
    for (const std::string& file : files) {
        CAPTURE(file);
        const auto picture = read_picture(file);
        INFO((picture ? std::string() : picture.error().message));
        REQUIRE(picture.has_value());
        CHECK(picture->width == 2);
        CHECK(picture->height == 2);
        CHECK(picture->pixels == colours);
    }
}

TEST_CASE("a file that is not a picture is refused with its name", "[sim][floor]") {
    const Scratch scratch;
    const std::string text = scratch.write("floor.jpg", "no picture").string();
    CHECK(refusal(text) ==
          "'" + text +
              "' can't be read as a picture: OpenCV can't read its format (PNG, JPEG, BMP, TIFF, WebP, "
              "PPM and others are possible)");
    const std::string torn = scratch.write("floor.bmp", bitmap().substr(0, 30)).string();
    CHECK(refusal(torn).find("'" + torn + "' can't be read as a picture: ") == 0);
    const std::string empty = scratch.write("empty.jpg", "").string();
    CHECK(refusal(empty) == "'" + empty + "' can't be read as a picture: it is empty");
    std::string wide = bitmap();
    wide.replace(18, 4, "\xff\xff\xff\x7f", 4);  // its width
    const std::string too_wide = scratch.write("wide.bmp", wide).string();
    CHECK(refusal(too_wide).find("'" + too_wide + "' can't be read as a picture: OpenCV reports: ") == 0);
    CHECK(refusal(too_wide).find('\n') == std::string::npos);
    const std::string gone = scratch.path("gone.jpg").string();
    CHECK(refusal(gone).find("'" + gone + "' can't be read as a picture: ") == 0);
}

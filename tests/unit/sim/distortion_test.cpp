// Lens distortion: where a lens shows a point of the pinhole's picture.
#include "sim/distortion.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "engine/world/camera_source.hpp"

using namespace nezumi;
using namespace nezumi::sim;

namespace {

struct Pixel {
    double column, row;
};

// Written again from the formula in the message, to check it.
Pixel seen_at(const CameraIntrinsics& c, double a, double b) {
    const double r2 = a * a + b * b, radial = 1 + c.k1 * r2 + c.k2 * r2 * r2 + c.k3 * r2 * r2 * r2;
    const double u = a * radial + 2 * c.p1 * a * b + c.p2 * (r2 + 2 * a * a);
    const double v = b * radial + c.p1 * (r2 + 2 * b * b) + 2 * c.p2 * a * b;
    return {c.cx + c.fx * u, c.cy + c.fy * v};
}

// The middle of what is bright in one colour.
Pixel middle_of(const std::vector<std::uint8_t>& pixels, int width, int channels, int channel) {
    double sum = 0, column = 0, row = 0;
    for (std::size_t i = 0; i * channels < pixels.size(); ++i) {
        const double value = pixels[i * channels + channel];
        sum += value;
        column += value * static_cast<double>(i % width);
        row += value * static_cast<double>(i / width);
    }
    return {column / sum, row / sum};
}

CameraIntrinsics distorted(double k1, double k2 = 0, double p1 = 0, double p2 = 0, double k3 = 0) {
    return CameraSettings{
        .width = 320, .height = 200, .field_of_view = 1.0, .k1 = k1, .k2 = k2, .p1 = p1, .p2 = p2, .k3 = k3}
        .intrinsics();
}

}  // namespace

TEST_CASE("each coefficient moves a point as the formula says", "[sim][distortion]") {
    for (const CameraIntrinsics& c :
         {distorted(-0.3), distorted(0.3), distorted(-0.2, 0.3), distorted(0, 0, 0.03), distorted(0, 0, 0, -0.03),
          distorted(0, 0, 0, 0, 1.5), distorted(-0.25, 0.1, 0.01, -0.02, 0.2)}) {
        const auto distortion = Distortion::make(c);
        REQUIRE(distortion);
        const CameraIntrinsics& p = distortion->pinhole();
        CHECK(p.k1 == 0);
        for (const auto& [a, b] : {std::pair{0.0, 0.0}, {0.4, 0.0}, {0.0, 0.25}, {-0.42, 0.2}, {0.35, -0.25}}) {
            std::vector<std::uint8_t> painted(std::size_t{p.width} * p.height * 3), distorted;
            // A soft spot whose middle is between pixels.
            const double column = p.cx + p.fx * a, row = p.cy + p.fy * b;
            for (int y = 0; y < p.height; ++y) {
                for (int x = 0; x < p.width; ++x) {
                    const double squared = (x - column) * (x - column) + (y - row) * (y - row);
                    painted[3 * (static_cast<std::size_t>(y) * p.width + x) + 1] =
                        static_cast<std::uint8_t>(std::lround(250 * std::exp(-squared / 4)));
                }
            }
            distortion->apply(painted, 3, distorted);
            REQUIRE(distorted.size() == 320 * 200 * 3);
            const Pixel expected = seen_at(c, a, b), seen = middle_of(distorted, 320, 3, 1);
            INFO(c.k1 << " " << c.k2 << " " << c.p1 << " " << c.p2 << " " << c.k3 << " at " << a << ", " << b);
            CHECK(seen.column == Approx(expected.column).margin(0.1));
            CHECK(seen.row == Approx(expected.row).margin(0.1));
        }
    }
}

TEST_CASE("barrel distortion shows more than a pinhole, pincushion distortion less", "[sim][distortion]") {
    const auto barrel = Distortion::make(distorted(-0.25)), pincushion = Distortion::make(distorted(0.25));
    REQUIRE(barrel);
    REQUIRE(pincushion);
    CHECK(barrel->pinhole().width > 340);
    CHECK(barrel->pinhole().height > 210);
    CHECK(pincushion->pinhole().width < 310);
    // All white, so anything taken from outside the painted picture would be dark.
    for (const auto* distortion : {&*barrel, &*pincushion}) {
        std::vector<std::uint8_t> white(std::size_t{distortion->pinhole().width} * distortion->pinhole().height, 255),
            distorted;
        distortion->apply(white, 1, distorted);
        CHECK(distorted == std::vector<std::uint8_t>(320 * 200, 255));
    }
}

TEST_CASE("a distortion that folds the picture is refused", "[sim][distortion]") {
    for (const CameraIntrinsics& c : {distorted(-2), distorted(-1.2), distorted(0, -2), distorted(0, 0, 0, 0, -2)}) {
        const auto refused = Distortion::make(c);
        REQUIRE_FALSE(refused);
        CHECK(refused.error().message.find("folds the picture over: take smaller ones, or a smaller field of view") !=
              std::string::npos);
    }
    CHECK(
        Distortion::make(distorted(-1.2, 0, 0.01)).error().message ==
        "a distortion of k1 = -1.2, k2 = 0, p1 = 0.01, p2 = 0, k3 = 0 folds the picture over: take smaller ones, or a "
        "smaller field of view");
}

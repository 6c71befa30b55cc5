// Blur and noise, pixel by pixel.
#include "sim/image_noise.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace nezumi::sim;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes noisy(double sigma, std::uint64_t seed, std::uint64_t frame, std::size_t row = 300, std::uint8_t value = 128) {
    Bytes pixels(row * 400, value);
    ImageNoise(sigma, seed).add_to(pixels, row, frame);
    return pixels;
}

}  // namespace

TEST_CASE("noise has its deviation and mean 0, in each row and in the whole picture", "[sim][noise]") {
    for (const double sigma : {0.5, 2.0, 10.0}) {
        const Bytes pixels = noisy(sigma, 1, 1);
        double sum = 0, squares = 0;
        for (const int p : pixels) {
            sum += p - 128;
            squares += (p - 128) * (p - 128);
        }
        const double count = static_cast<double>(pixels.size());
        CHECK(sum / count == Approx(0).margin(0.02 * sigma));
        // A value is rounded, which adds the variance 1 / 12.
        CHECK(std::sqrt(squares / count) == Approx(std::sqrt(sigma * sigma + 1.0 / 12)).epsilon(0.02));
    }
    CHECK(noisy(0, 1, 1) == Bytes(300 * 400, 128));
}

TEST_CASE("noise depends only on seed and frame", "[sim][noise]") {
    CHECK(noisy(10, 1, 5) == noisy(10, 1, 5));
    CHECK(noisy(10, 1, 5) != noisy(10, 2, 5));
    CHECK(noisy(10, 1, 5) != noisy(10, 1, 6));
    const ImageNoise noise(10, 1);
    Bytes first(300 * 400, 128), second = first;
    noise.add_to(first, 300, 9);
    noise.add_to(second, 300, 5);
    CHECK(second == noisy(10, 1, 5));
}

TEST_CASE("each row has noise of its own", "[sim][noise]") {
    const Bytes pixels = noisy(10, 3, 0);
    for (std::size_t row = 1; row < 400; ++row) {
        REQUIRE_FALSE(std::equal(pixels.begin(), pixels.begin() + 300, pixels.begin() + 300 * row));
    }
}

TEST_CASE("noise keeps values from 0 to 255", "[sim][noise]") {
    const Bytes black = noisy(100, 1, 1, 300, 0), white = noisy(100, 1, 1, 300, 255);
    CHECK(*std::max_element(black.begin(), black.end()) == 255);
    CHECK(std::count(black.begin(), black.end(), 0) == Approx(60'000).margin(2000));
    CHECK(*std::min_element(white.begin(), white.end()) == 0);
    CHECK(std::count(white.begin(), white.end(), 255) == Approx(60'000).margin(2000));
}

TEST_CASE("blur spreads a point as a Gaussian, equally along rows and columns", "[sim][noise]") {
    Bytes point(31 * 21, 0);
    const auto at = [&](int column, int row) -> std::uint8_t& { return point[row * 31 + column]; };
    at(15, 10) = 250;
    blur_picture(point, 31, 21, 1, 1.0);
    const int middle = at(15, 10);
    CHECK(middle == Approx(250 / (2 * M_PI)).margin(2));
    for (const int away : {1, 2}) {
        const int expected = at(15 + away, 10);
        CHECK(expected == Approx(middle * std::exp(-0.5 * away * away)).margin(2));
        CHECK(at(15 - away, 10) == expected);
        CHECK(at(15, 10 + away) == expected);
        CHECK(at(15, 10 - away) == expected);
    }
    CHECK(at(15, 16) == 0);
    CHECK(at(22, 10) == 0);
}

TEST_CASE("blur does not mix colour channels", "[sim][noise]") {
    Bytes picture(30 * 20 * 3, 0);
    for (std::size_t row = 0; row < 20; ++row) {
        for (std::size_t column = 0; column < 30; ++column) {
            std::uint8_t* pixel = &picture[3 * (row * 30 + column)];
            pixel[0] = 77;
            pixel[1] = column < 12 ? 0 : 200;  // an upright edge
            pixel[2] = row < 7 ? 0 : 200;      // a level one
        }
    }
    blur_picture(picture, 30, 20, 3, 1.5);
    for (std::size_t row = 0; row < 20; ++row) {
        for (std::size_t column = 0; column < 30; ++column) {
            // How much of a Gaussian lies beyond the edge.
            const auto expected = [](double pixels) { return 100 * (1 + std::erf((pixels + 0.5) / (1.5 * M_SQRT2))); };
            const std::uint8_t* pixel = &picture[3 * (row * 30 + column)];
            REQUIRE(pixel[0] == 77);
            REQUIRE(pixel[1] == Approx(expected(static_cast<double>(column) - 12)).margin(4));
            REQUIRE(pixel[2] == Approx(expected(static_cast<double>(row) - 7)).margin(4));
        }
    }
}

TEST_CASE("zero blur changes nothing, and edge pixels are repeated beyond the edge", "[sim][noise]") {
    Bytes picture(30 * 20, 200);
    for (std::size_t i = 0; i < picture.size(); i += 7) picture[i] = 10;
    Bytes same = picture;
    blur_picture(same, 30, 20, 1, 0);
    CHECK(same == picture);
    Bytes plain(30 * 20 * 3, 77);
    blur_picture(plain, 30, 20, 3, 4);
    CHECK(plain == Bytes(30 * 20 * 3, 77));
}

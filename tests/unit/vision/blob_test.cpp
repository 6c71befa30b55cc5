// The largest connected region of a mask, and its properties.
#include "engine/vision/blob.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>

using namespace nezumi;

namespace {

// A mask as a drawing: every character other than a point is marked.
GrayImage mask_of(const std::vector<std::string>& rows) {
    GrayImage mask{static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), {}};
    for (const std::string& row : rows) {
        for (const char c : row) mask.pixels.push_back(c == '.' ? 0 : 255);
    }
    return mask;
}

}  // namespace

TEST_CASE("the largest region counts, and of two equal ones the higher one", "[vision][blob]") {
    const auto blob = largest_blob(mask_of({"#....##", "#....##", ".......", "..###.."}));
    REQUIRE(blob);
    CHECK(blob->x == Approx(5.5));
    CHECK(blob->y == Approx(0.5));
    CHECK(blob->area == 4);
    CHECK(largest_blob(mask_of({".......", "...##..", ".......", "##....."}))->y == 1);
    CHECK(largest_blob(mask_of({"......#", "#......"}))->y == 0);
    CHECK_FALSE(largest_blob(mask_of({"...", "..."})));
    CHECK(largest_blob(mask_of({"#"}))->area == 1);
}

TEST_CASE("pixels that touch at a corner are one region", "[vision][blob]") {
    const auto blob = largest_blob(mask_of({"#..##", ".#...", "..#..", "...#."}));
    REQUIRE(blob);
    CHECK(blob->area == 4);
    CHECK(blob->x == 1.5);
    CHECK(blob->y == 1.5);
}

TEST_CASE("the angle of the long axis is measured from the vertical, positive to the left", "[vision][blob]") {
    CHECK(largest_blob(mask_of({".#.", ".#.", ".#."}))->angle == Approx(0).margin(1e-9));
    CHECK(std::abs(largest_blob(mask_of({"...", "###", "..."}))->angle) == Approx(M_PI / 2));
    CHECK(largest_blob(mask_of({"#..", ".#.", "..#"}))->angle == Approx(M_PI / 4));
    CHECK(largest_blob(mask_of({"..#", ".#.", "#.."}))->angle == Approx(-M_PI / 4));
}

TEST_CASE("a position in a picture is relative to its middle, 1 at the first edge", "[vision][blob]") {
    CHECK(from_middle(0, 1) == 0);
    CHECK(from_middle(-0.5, 640) == 1);
    CHECK(from_middle(639.5, 640) == -1);
    CHECK(from_middle(319.5, 640) == 0);
    CHECK(from_middle(0, 2) == 0.5);
}

// The chessboard that cameras are calibrated with in simulation.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/world/chessboard.hpp"

using namespace nezumi;

TEST_CASE("a chessboard has a square more than inner corners, and a white margin", "[engine][chessboard]") {
    const ChessboardSpec spec{.columns = 4, .rows = 3, .square = 0.02, .at = {1, 2}};
    const std::vector<BoxSpec> squares = chessboard(spec);
    REQUIRE(squares.size() == (4 + 1 + 2) * (3 + 1 + 2));
    const auto is_black = [](const BoxSpec& box) { return box.color == "#101010"; };
    CHECK(std::count_if(squares.begin(), squares.end(), is_black) == 5 * 4 / 2);
    for (const BoxSpec& box : squares) {
        CHECK(box.size == Point3D{0.02, 0.02, 0.001});
        CHECK(box.at.z == 0.0005);
        // Around its centre, the margin white.
        const double x = std::abs(box.at.x - 1) / 0.02, y = std::abs(box.at.y - 2) / 0.02;
        CHECK(x < 3 + 1e-9);
        CHECK(y < 2.5 + 1e-9);
        if (x > 2.5 || y > 2) CHECK_FALSE(is_black(box));
    }
}

TEST_CASE("a camera is held over a chessboard so that it looks at it from above", "[engine][chessboard]") {
    const ChessboardSpec spec{.at = {1, 2}};
    for (int number = 0; number < 20; ++number) {
        const CameraMount mount = view_of_chessboard(spec, number);
        CAPTURE(number);
        CHECK(mount.robot.empty());
        CHECK(mount.pitch > 0.7);
        CHECK(mount.pitch < M_PI / 2);
        // Where its axis meets the floor is within the board.
        const double reach = mount.at.z / std::tan(mount.pitch);
        CHECK(std::abs(mount.at.x + reach * std::cos(mount.yaw) - 1) < 0.25 / 4 + 1e-9);
        CHECK(std::abs(mount.at.y + reach * std::sin(mount.yaw) - 2) < 0.25 / 4 + 1e-9);
    }
    CHECK(CameraMount{}.pitch == 0);
    CHECK(CameraMount{}.yaw == 0);
}

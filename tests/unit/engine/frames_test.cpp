// Poses as they are seen from other poses.
#include "engine/world/frames.hpp"

#include <catch2/catch.hpp>

#include <numbers>

namespace nezumi {
namespace {

constexpr double quarter = std::numbers::pi / 2;

void check_near(const Pose2D& pose, const Pose2D& expected) {
    CHECK(pose.position.x == Approx(expected.position.x).margin(1e-12));
    CHECK(pose.position.y == Approx(expected.position.y).margin(1e-12));
    CHECK(pose.heading == Approx(expected.heading).margin(1e-12));
}

TEST_CASE("a point ahead of a pose is on the x axis of its frame", "[engine][frames]") {
    const Pose2D robot{{1, 2}, quarter};
    check_near(seen_from(robot, {{1, 5}, quarter}), {{3, 0}, 0});
    check_near(seen_from(robot, {{0, 2}, 0}), {{0, 1}, -quarter});
    check_near(seen_from(robot, robot), {});
}

TEST_CASE("a pose seen from another and placed at it again is itself", "[engine][frames]") {
    for (const Pose2D& frame : {Pose2D{}, Pose2D{{1, 2}, quarter}, Pose2D{{-0.3, 4}, 2.9}, Pose2D{{5, -1}, -9.0}}) {
        for (const Pose2D& pose : {Pose2D{{0.5, -2}, 1.1}, Pose2D{{-7, 0.1}, -3.0}})
            check_near(placed_at(frame, seen_from(frame, pose)), pose);
    }
}

TEST_CASE("a heading seen from another lies within half a turn", "[engine][frames]") {
    CHECK(seen_from({{0, 0}, 3.0}, {{0, 0}, -3.0}).heading == Approx(2 * std::numbers::pi - 6.0));
    CHECK(placed_at({{0, 0}, 3.0}, {{0, 0}, 3.0}).heading == Approx(6.0 - 2 * std::numbers::pi));
}

TEST_CASE("a point turned by an angle and back is where it was", "[engine][frames]") {
    CHECK(turned({1, 0}, quarter).y == 1);
    CHECK(turned({0, 0}, 1.2) == Point2D{0, 0});
    const Point2D back = turned(turned({0.3, -0.2}, 0.7), -0.7);
    CHECK(back.x == Approx(0.3));
    CHECK(back.y == Approx(-0.2));
}

}  // namespace
}  // namespace nezumi

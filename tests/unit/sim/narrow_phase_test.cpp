// Where two shapes touch, and what a wheel can roll over.
#include "sim/narrow_phase.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/ode_library.hpp"

using namespace nezumi::sim;

namespace {

Shape box(Vec3 centre, Vec3 half, double yaw = 0, double pitch = 0) {
    return {Shape::Kind::box, centre, yaw_pitch_rotation(yaw, pitch), half};
}
Shape disc(Vec3 centre, double radius, double half_height = 0.5) {
    return {Shape::Kind::cylinder, centre, Rotation::Identity(), {radius, radius, half_height}};
}

struct Narrow {
    OdeLibrary library;
    NarrowPhase phase;
    double deepest(const Shape& a, const Shape& b) {
        double depth = 0;
        for (const Touch& touch : phase.collide(a, b)) depth = std::max(depth, touch.depth);
        return depth;
    }
};

}  // namespace

TEST_CASE("half the height of a shape depends on its rotation", "[sim][narrow]") {
    const double c = std::cos(0.5), s = std::sin(0.5);
    CHECK(box({0, 0, 0}, {0.1, 0.2, 0.3}, 0.7).half_height() == Approx(0.3));
    CHECK(box({0, 0, 0}, {0.1, 0.2, 0.3}, 0, 0.5).half_height() == Approx(0.3 * c + 0.1 * s));
    CHECK(box({0, 0, 0}, {0.1, 0.2, 0.3}, 0.7, 0.5).half_height() == Approx(0.3 * c + 0.1 * s));
    Shape rolled = box({0, 0, 0}, {0.1, 0.2, 0.3});
    rolled.rotation << 1, 0, 0, 0, c, -s, 0, s, c;
    CHECK(rolled.half_height() == Approx(0.3 * c + 0.2 * s));
    Shape tilted = disc({0, 0, 0}, 0.1, 0.3);
    tilted.rotation = rolled.rotation;
    CHECK(tilted.half_height() == Approx(0.3 * c + 0.1 * s));
}

TEST_CASE("shapes whose surfaces only meet do not touch", "[sim][narrow]") {
    Narrow n;
    const Shape square = box({0, 0, 0}, {0.5, 0.5, 0.5}), round = disc({0, 0, 0}, 0.25);
    CHECK(n.phase.collide(round, disc({0.5, 0, 0}, 0.25)).empty());
    CHECK(n.phase.collide(square, disc({0.75, 0, 0}, 0.25)).empty());
    CHECK(n.phase.collide(disc({0, -0.75, 0}, 0.25), square).empty());
    CHECK(n.phase.collide(square, box({1, 0, 0}, {0.5, 0.5, 0.5})).empty());
    CHECK(n.phase.collide(square, box({0, 0, 1}, {0.5, 0.5, 0.5})).empty());
    CHECK(n.phase.collide(round, disc({0, 0, 1}, 0.25)).empty());
    CHECK(n.phase.collide(square, disc({2, 0, 0}, 0.25)).empty());
    // Slightly nearer they do.
    CHECK(n.phase.collide(round, disc({0.4999, 0, 0}, 0.25)).size() == 1);
    CHECK(n.phase.collide(square, disc({0.7499, 0, 0}, 0.25)).size() == 1);
    CHECK_FALSE(n.phase.collide(square, box({0.9999, 0, 0}, {0.5, 0.5, 0.5})).empty());
}

TEST_CASE("moving the first shape along the normal by the depth separates the two", "[sim][narrow]") {
    Narrow n;
    const std::vector<std::pair<Shape, Shape>> pairs{
        {disc({0, 0, 0}, 0.25), disc({0.3, 0.2, 0.1}, 0.2)},
        {disc({0, 0, 0}, 0.25), disc({0, 0, 0}, 0.2)},
        {disc({0, 0, 0}, 0.25), box({0.5, 0.1, 0}, {0.3, 0.2, 0.4}, 0.4)},
        {box({0.5, 0.1, 0}, {0.3, 0.2, 0.4}, 0.4), disc({0, 0, 0}, 0.25)},
        {disc({0.72, 0.1, 0}, 0.1), box({0.5, 0.1, 0}, {0.3, 0.2, 0.4})},  // its centre is inside
        {disc({0.5, -0.05, 0}, 0.1), box({0.5, 0.1, 0}, {0.3, 0.2, 0.4})},
        {disc({0.3, 0.3, 0}, 0.25), box({0, 0, 0}, {0.2, 0.2, 0.4})},  // at a corner
        {box({0, 0, 0}, {0.2, 0.2, 0.2}), box({0.35, 0.1, 0.05}, {0.2, 0.2, 0.2})},
        {disc({0, 0, 0.95}, 0.1), disc({0, 0, 0}, 0.3)}};  // one stands on the other
    for (const auto& [a, b] : pairs) {
        const double depth = n.deepest(a, b);
        INFO(a.centre.transpose() << " and " << b.centre.transpose());
        REQUIRE(depth > 0);
        for (const Touch& touch : n.phase.collide(a, b)) {
            CHECK(touch.normal.norm() == Approx(1));
            if (touch.depth < depth) continue;
            Shape freed = a;
            freed.centre += touch.normal * (depth + 1e-6);
            CHECK(NarrowPhase().collide(freed, b).empty());
            break;
        }
    }
}

TEST_CASE("discs touch half way between their rims, at the height that both reach", "[sim][narrow]") {
    Narrow n;
    const auto touches = n.phase.collide(disc({0, 0, 0}, 0.25, 0.5), disc({0.4, 0, 0.8}, 0.2, 0.5));
    REQUIRE(touches.size() == 1);
    CHECK(touches[0].depth == Approx(0.05));
    CHECK(touches[0].normal.isApprox(Vec3(-1, 0, 0)));
    CHECK(touches[0].at.isApprox(Vec3(0.225, 0, 0.4)));
}

TEST_CASE("a disc whose centre is inside a box is pushed out by the nearest face", "[sim][narrow]") {
    Narrow n;
    const Shape square = box({0, 0, 0}, {0.3, 0.2, 0.5});
    for (const auto& [x, y, depth, normal] : {std::tuple{0.25, 0.0, 0.15, Vec3(1, 0, 0)},
                                              {-0.25, 0.0, 0.15, Vec3(-1, 0, 0)},
                                              {0.0, 0.15, 0.15, Vec3(0, 1, 0)},
                                              {0.0, -0.15, 0.15, Vec3(0, -1, 0)},
                                              {0.22, 0.1, 0.18, Vec3(1, 0, 0)},
                                              {0.1, 0.12, 0.18, Vec3(0, 1, 0)}}) {
        INFO(x << ", " << y);
        const auto touches = n.phase.collide(disc({x, y, 0}, 0.1), square);
        REQUIRE(touches.size() == 1);
        CHECK(touches[0].depth == Approx(depth));
        CHECK(touches[0].normal.isApprox(normal));
        CHECK(touches[0].at.isApprox(Vec3(x, y, 0)));
    }
}

TEST_CASE("a wheel rests on the edge of a kerb, but not on a wall", "[sim][narrow]") {
    const double radius = 0.024;
    const Vec3 axle{0, 0, radius}, axis = Vec3::UnitY();
    // The kerb's edge is 10 mm ahead and 5 mm high.
    const auto touch = touch_wheel(box({0.11, 0, 0}, {0.1, 0.2, 0.005}), axle, axis, radius);
    REQUIRE(touch);
    const double distance = std::hypot(0.01, radius - 0.005);
    CHECK(touch->depth == Approx(radius - distance));
    CHECK(touch->normal.isApprox(Vec3(-0.01, 0, radius - 0.005) / distance, 1e-9));
    CHECK(touch->at.isApprox(Vec3(0.01, 0, 0.005), 1e-9));
    CHECK(touch_wheel(box({-0.11, 0, 0}, {0.1, 0.2, 0.005}), axle, axis, radius)->normal.x() > 0);
    CHECK(touch_wheel(disc({0.11, 0, 0}, 0.1, 0.005), axle, axis, radius)->at.isApprox(Vec3(0.01, 0, 0.005), 1e-9));

    CHECK_FALSE(touch_wheel(box({0.13, 0, 0}, {0.1, 0.2, 0.005}), axle, axis, radius));           // out of reach
    CHECK_FALSE(touch_wheel(box({0.123, 0, 0}, {0.1, 0.2, 0.023}), axle, axis, radius));          // as steep as a wall
    CHECK_FALSE(touch_wheel(box({0.11, 0.3, 0}, {0.1, 0.2, 0.005}), axle, axis, radius));         // beside the wheel
    CHECK_FALSE(touch_wheel(box({0, 0, 0.02}, {0.1, 0.2, 0.1}), axle, axis, radius));             // around the axle
    CHECK_FALSE(touch_wheel(box({0.11, 0, 0}, {0.1, 0.2, 0.005}), axle, Vec3::UnitZ(), radius));  // it lies on its side
}

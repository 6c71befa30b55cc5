// Rays against boxes and cylinders, alone and through the grid.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "sim/ray_caster.hpp"

using namespace nezumi::sim;

namespace {

Shape solid_box(Vec3 centre, Vec3 size, double yaw = 0, double pitch = 0) {
    return {Shape::Kind::box, centre, yaw_pitch_rotation(yaw, pitch), size * 0.5};
}
Shape cylinder(Vec3 centre, double radius, double height) {
    return {Shape::Kind::cylinder, centre, Rotation::Identity(), {radius, radius, height / 2}};
}

// The first place along the ray where `inside` is true, in steps of 0.5 mm: slow, but independent of the formulas.
double march(const Shape& shape, Vec3 from, Vec3 direction, double range) {
    for (double t = 0; t <= range; t += 5e-4) {
        const Vec3 p = rotate_back(shape.rotation, from + direction * t - shape.centre);
        const bool inside = shape.kind == Shape::Kind::box
                                ? std::abs(p.x()) <= shape.half.x() && std::abs(p.y()) <= shape.half.y() &&
                                      std::abs(p.z()) <= shape.half.z()
                                : std::hypot(p.x(), p.y()) <= shape.half.x() && std::abs(p.z()) <= shape.half.z();
        if (inside) return t;
    }
    return nothing;
}

}  // namespace

TEST_CASE("a ray meets a box at its face, with the face's normal", "[sim][ray]") {
    Vec3 normal;
    CHECK(cast_ray(solid_box({1, 0, 0}, {0.2, 1, 1}), {0, 0, 0}, {1, 0, 0}, 2, &normal) == Approx(0.9).margin(1e-12));
    CHECK(normal.x() == Approx(-1));
    CHECK(cast_ray(solid_box({1, 0, 0}, {0.2, 1, 1}), {0, 0, 0}, {-1, 0, 0}, 2) == nothing);
    CHECK(cast_ray(solid_box({1, 0, 0}, {0.2, 1, 1}), {0, 0, 0}, {1, 0, 0}, 0.89) == nothing);
    CHECK(cast_ray(solid_box({1, 0, 0}, {0.2, 1, 1}), {0, 0, 0.51}, {1, 0, 0}, 2) == nothing);
    CHECK(cast_ray(solid_box({0, 0, -0.5}, {1, 1, 1}, 0, 0.1), {0, 0, 1}, {0, 0, -1}, 3, &normal) < 1);
    CHECK(normal.x() == Approx(std::sin(0.1)));
    CHECK(normal.z() == Approx(std::cos(0.1)));
}

TEST_CASE("a ray meets a cylinder at its side and its cap", "[sim][ray]") {
    Vec3 normal;
    CHECK(cast_ray(cylinder({1, 0, 0}, 0.25, 1), {0, 0, 0}, {1, 0, 0}, 2, &normal) == Approx(0.75).margin(1e-12));
    CHECK(normal.x() == Approx(-1));
    CHECK(cast_ray(cylinder({1, 0, 0}, 0.25, 1), {0, 0.2, 0}, {1, 0, 0}, 2) == Approx(1 - 0.15).margin(1e-12));
    CHECK(cast_ray(cylinder({1, 0, 0}, 0.25, 1), {0, 0.26, 0}, {1, 0, 0}, 2) == nothing);
    CHECK(cast_ray(cylinder({0, 0, 0}, 0.25, 1), {0.1, 0, 2}, {0, 0, -1}, 2, &normal) == Approx(1.5).margin(1e-12));
    CHECK(normal.z() == Approx(1));
}

TEST_CASE("a ray that starts inside a thing has distance 0", "[sim][ray]") {
    CHECK(cast_ray(solid_box({0, 0, 0}, {1, 1, 1}), {0.1, 0, 0}, {1, 0, 0}, 1) == 0);
    CHECK(cast_ray(cylinder({0, 0, 0}, 1, 1), {0.1, 0, 0}, {1, 0, 0}, 1) == 0);
}

TEST_CASE("ray distances agree with stepping along the rays", "[sim][ray]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(-1, 1);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        Shape shape =
            i % 2 == 0 ? solid_box({u(random), u(random), u(random)}, {0.6, 0.3, 0.5}, 3 * u(random), 0.5 * u(random))
                       : cylinder({u(random), u(random), u(random)}, 0.3, 0.8);
        if (i % 4 == 1) shape.rotation = yaw_pitch_rotation(3 * u(random), u(random));
        const Vec3 from{u(random), u(random), u(random)};
        const Vec3 direction = (shape.centre + Vec3{u(random), u(random), u(random)} * 0.4 - from).normalized();
        const double expected = march(shape, from, direction, 1.5);
        const double actual = cast_ray(shape, from, direction, 1.5);
        // A ray that grazes an edge may pass between two steps.
        if (expected == nothing) {
            if (actual < nothing)
                CHECK(march(shape, from + direction * (actual - 1e-3), direction * 0.01, 0.4) < nothing);
        } else {
            CHECK(actual == Approx(expected).margin(6e-4));
            ++hits;
        }
    }
    CHECK(hits > 150);
}

TEST_CASE("a fan gives the same with the grid as with a test of every shape", "[sim][ray][grid]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-1, 1);
    Scene scene;
    for (int i = 0; i < 60; ++i) {
        scene.add_fixed(solid_box({8 * u(random), 8 * u(random), 0.1}, {0.1, i == 0 ? 30.0 : 1.0, 0.3}, 3 * u(random)));
    }
    scene.add_fixed(solid_box({0, 0, -500}, {1000, 1000, 1000}));  // too large for the grid
    for (int i = 0; i < 80; ++i) scene.add_mover(cylinder({8 * u(random), 8 * u(random), 0.05}, 0.085, 0.1));
    scene.add_mover(solid_box({0, 0, 0.2}, {3, 0.1, 0.4}));  // a large one
    for (Scene::Index i = 0; i < 80; i += 2) scene.mover(i).centre = {8 * u(random), 8 * u(random), 0.05};
    scene.refresh();

    RayFan fan;
    for (std::size_t i = 0; i < 24; ++i) {
        const double angle = static_cast<double>(i) * M_PI / 12;
        fan.add(
            {{0.085 * std::cos(angle), 0.085 * std::sin(angle), 0.01}, {std::cos(angle), std::sin(angle), 0}, 0.6, i});
    }
    std::vector<double> seen(24), expected(24);
    int hits = 0;
    for (Scene::Index self = 0; self < 80; ++self) {
        const Shape& robot = scene.movers()[self];
        cast_rays(scene, fan, robot.centre, robot.rotation, self, seen);
        std::fill(expected.begin(), expected.end(), nothing);
        for (const auto& ray : fan.rays) {
            for (const Shape& shape : scene.fixed()) {
                expected[ray.sensor] =
                    std::min(expected[ray.sensor], cast_ray(shape, robot.centre + ray.from, ray.direction, 0.6));
            }
            for (Scene::Index i = 0; i < scene.movers().size(); ++i) {
                if (i == self) continue;
                expected[ray.sensor] = std::min(
                    expected[ray.sensor], cast_ray(scene.movers()[i], robot.centre + ray.from, ray.direction, 0.6));
            }
        }
        CHECK(seen == expected);
        hits += static_cast<int>(std::count_if(seen.begin(), seen.end(), [](double d) { return d < nothing; }));
    }
    CHECK(hits > 100);
}

TEST_CASE("a sensor of several rays gives the nearest hit", "[sim][ray]") {
    Scene scene;
    scene.add_fixed(cylinder({0.5, 0.05, 0}, 0.02, 1));
    RayFan fan;
    for (int i = -5; i <= 5; ++i) {
        const double angle = 0.02 * i;
        fan.add({Vec3::Zero(), {std::cos(angle), std::sin(angle), 0}, 1, 0});
    }
    std::vector<double> seen(1);
    cast_rays(scene, fan, Vec3::Zero(), Rotation::Identity(), Scene::nobody, seen);
    CHECK(seen[0] == Approx(0.4825).margin(0.001));
}

TEST_CASE("a scan gives the same as its rays one by one, for any place and tilt", "[sim][ray]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-1, 1);
    Scene scene;
    for (int i = 0; i < 30; ++i) {
        scene.add_fixed(solid_box({4 * u(random), 4 * u(random), 0.1}, {0.1, i == 0 ? 30.0 : 1.0, 0.3}, 3 * u(random)));
        scene.add_mover(cylinder({4 * u(random), 4 * u(random), 0.05}, 0.085, 0.1));
    }
    scene.refresh();
    int hits = 0;
    for (int round = 0; round < 300; ++round) {
        const bool is_closed = round % 3 == 0;
        const std::size_t count = 2 + static_cast<std::size_t>(round % 90);
        const double cone = is_closed ? 2 * M_PI : 0.1 + 3 * std::abs(u(random));
        RayFan one_by_one, scan;
        one_by_one.add({{0.03, 0, 0}, {0, 1, 0}, 0.5, 0});
        scan.add(one_by_one.rays.front());
        scan.add_scan({.from = {0.1 * u(random), 0.1 * u(random), 0.02}, .range = 3, .sensor = 1}, 7 * u(random),
                      cone / static_cast<double>(is_closed ? count : count - 1), count);
        scan.add({{0.03, 0, 0}, {0, -1, 0}, 0.5, count + 1});
        for (const RayFan::RayFrom& ray : std::span(scan.rays).subspan(1)) one_by_one.add(ray);
        Vec3 axis(u(random), u(random), u(random));
        const Rotation turned(Eigen::AngleAxisd((round % 2 == 0 ? 0.1 : 3) * u(random), axis.normalized()));
        const Rotation rotation = turned * yaw_rotation(3 * u(random));
        const Vec3 centre(3 * u(random), 3 * u(random), 0.06);
        std::vector<double> expected(count + 2), seen(count + 2);
        cast_rays(scene, one_by_one, centre, rotation, Scene::nobody, expected);
        cast_rays(scene, scan, centre, rotation, Scene::nobody, seen);
        CHECK(seen == expected);
        hits += static_cast<int>(std::count_if(seen.begin(), seen.end(), [](double d) { return d < nothing; }));
        // Only the rays before and after the scan.
        std::vector<std::uint8_t> due(count + 2, 0);
        due.front() = due.back() = 1;
        std::vector<double> few(count + 2);
        cast_rays(scene, scan, centre, rotation, Scene::nobody, few, due);
        CHECK(few.front() == expected.front());
        CHECK(few.back() == expected.back());
        CHECK(std::all_of(few.begin() + 1, few.end() - 1, [](double d) { return d == nothing; }));
    }
    CHECK(hits > 2000);
}

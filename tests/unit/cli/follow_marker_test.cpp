// The shipped system in which the mouse follows a marker, from the picture to the wheels.
#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

#include "bindings/cli/base/environment.hpp"

using namespace nezumi;

namespace {

struct Follow {
    explicit Follow(int threads = 1) {
        LiveOptions options = cli::simulated_systems();
        options.build.threads = threads;
        auto loaded = RunningSystem::load("behaviors/systems/follow_marker.lua", std::move(options));
        INFO((loaded ? "" : describe(loaded.error())));
        REQUIRE(loaded);
        live = std::move(*loaded);
        live->activate();
    }
    const World& world() { return *live->system().world(); }
    Pose2D mouse() { return world().truth(0).pose; }
    Velocity2D velocity() { return world().truth(0).velocity; }
    // Puts the marker so far before the mouse, seen from its camera, facing it.
    void carry(double x, double y) { REQUIRE(live->act(MoveMarker{"target", {{x, y, 0.06}, {.y = M_PI}}}, {})); }
    double gap() {
        const Point3D marker = world().markers()[0].pose.position;
        return std::hypot(marker.x - mouse().position.x, marker.y - mouse().position.y) - 0.05;  // from the camera
    }
    void run(double seconds) {
        for (int i = 0; i < std::lround(seconds * 100); ++i) live->tick();
    }

    std::unique_ptr<RunningSystem> live;
};

}  // namespace

TEST_CASE("the mouse comes to half a metre from the marker and stays there", "[cli][marker][long]") {
    Follow follow;
    follow.run(10);
    CHECK(std::abs(follow.gap() - 0.5) < 0.1);
    CHECK(std::abs(follow.velocity().vx) < 1e-3);
}

TEST_CASE("the mouse follows a marker that is carried along a path", "[cli][marker][long]") {
    Follow follow;
    follow.run(6);
    double x = 1.0;
    for (int i = 0; i < 1500; ++i) {
        x += 0.0005;  // 5 cm/s
        follow.carry(x, 0.1 * std::sin(i / 200.0));
        follow.run(0.01);
        // Half a metre, half the band, and what the mouse needs to find out and to stop.
        if (i > 200) CHECK(std::abs(follow.gap() - 0.5) < 0.1);
    }
    CHECK(follow.mouse().position.x > 1.0);
}

TEST_CASE("the mouse stops when the marker disappears", "[cli][marker][long]") {
    Follow follow;
    follow.run(2);
    CHECK(follow.velocity().vx > 0.09);
    REQUIRE(follow.live->act(MoveMarker{"target", {{0, 0, -5}, {}}}, {}));
    follow.run(0.5);
    CHECK(std::abs(follow.velocity().vx) < 1e-3);
    const Pose2D there = follow.mouse();
    follow.run(2);
    CHECK(std::abs(follow.mouse().position.x - there.position.x) < 1e-3);
    follow.carry(follow.mouse().position.x + 1, 0);
    follow.run(1);
    CHECK(follow.velocity().vx > 0.09);
}

TEST_CASE("following a marker has the same trace however many threads run it", "[cli][marker][long]") {
    const auto trace = [](int threads) {
        Follow follow(threads);
        follow.run(2);
        return follow.live->trace_hash();
    };
    const auto one = trace(1);
    CHECK(trace(1) == one);
    CHECK(trace(3) == one);
}

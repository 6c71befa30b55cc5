// The shipped robots, and unusual ones, in the simulator.
#include <algorithm>
#include <filesystem>

#include "bindings/lua/files/robot_file.hpp"
#include "tests/unit/sim/try_world.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::sim;
namespace fs = std::filesystem;

namespace {

RobotSpec read(const fs::path& file) {
    const auto spec = read_robot_file(file, Project::of(file));
    INFO((spec ? "" : describe(spec.error())));
    REQUIRE(spec);
    return *spec;
}

std::vector<fs::path> shipped() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(source_root() + "/engine/robots")) {
        if (entry.path().extension() == ".lua") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

// Tests for any robot: rest, full speed at once, a stop, a turn.
void check_manners(const RobotSpec& spec, double speed) {
    TryWorld w;
    w.add(spec, 0, 0);
    double moved = 0, tilt = 0;
    w.run(3, [&] { moved = std::max(moved, std::abs(w.truth().velocity.vx) + std::abs(w.truth().velocity.va)); });
    CHECK(moved < 1e-6);
    CHECK(w.truth().tilt < 1e-4);
    CHECK(std::abs(w.truth().height) < 1e-4);
    const auto look = [&] { tilt = std::max(tilt, w.truth().tilt); };
    w.bodies[0]->set_wheel_speeds({speed, speed});
    w.run(1.5, look);
    CHECK(w.truth().velocity.vx == Approx(speed).epsilon(0.01));
    w.bodies[0]->set_wheel_speeds({-speed, -speed});
    w.run(1.5, look);
    CHECK(w.truth().velocity.vx == Approx(-speed).epsilon(0.01));
    w.bodies[0]->set_wheel_speeds({0, 0});
    w.run(1.5, look);
    CHECK(tilt < 0.5);
    CHECK(w.truth().tilt < 2e-3);
    w.bodies[0]->set_wheel_speeds({-0.05, 0.05});
    w.run(2, look);
    CHECK(w.truth().velocity.va == Approx(0.1 / spec.drive.track).epsilon(0.01));
    CHECK(w.warnings->empty());
}

}  // namespace

TEST_CASE("every shipped robot stands, drives at 1.5 m/s, stops and turns", "[sim][robot][fault]") {
    REQUIRE(shipped().size() >= 2);
    for (const fs::path& file : shipped()) {
        INFO(file);
        check_manners(read(file), 1.5);
    }
}

TEST_CASE("robots of unusual shapes and weights stay stable", "[sim][robot]") {
    for (const double mass : {0.01, 50.0}) {
        RobotSpec spec = mouse_spec();
        spec.mass = mass;
        INFO("mass " << mass);
        check_manners(spec, 0.5);
    }
    {
        RobotSpec tall = mouse_spec();
        tall.body = {BodySpec::Shape::cylinder, {0.1, 0.1, 0.3}, {0, 0, 0.16}};
        INFO("tall");
        check_manners(tall, 0.05);
    }
    {
        RobotSpec low = mouse_spec();  // the hull would drag over the floor
        low.body.at.z = 0.03;
        INFO("low");
        check_manners(low, 0.5);
    }
    {
        RobotSpec behind = mouse_spec();  // nearly all on the rear skid
        behind.body.at.x = -0.035;
        INFO("behind");
        check_manners(behind, 0.2);
    }
    {
        RobotSpec large = mouse_spec();
        large.mass = 40;
        large.body = {BodySpec::Shape::box, {0.8, 0.6, 0.4}, {0, 0, 0.25}};
        large.drive = {.radius = 0.1, .track = 0.5, .skid = 0.35};
        INFO("large");
        check_manners(large, 0.5);
    }
}

TEST_CASE("the mouse's sensors see a wall where its table was measured", "[sim][robot][sensor]") {
    const RobotSpec mouse = read(source_root() + "/engine/robots/raspimouse.lua");
    for (const double distance : {0.02, 0.05, 0.30}) {
        ArenaSpec arena;
        arena.boxes.push_back({.at = {0.035 + distance + 0.05, 0, 0.15}, .size = {0.1, 1, 0.3}});
        TryWorld w(arena);
        w.add(mouse, 0, 0);
        w.run(0.5);
        std::vector<double> seen(4);
        w.bodies[0]->read_ranges(seen);
        std::size_t looked = 0;
        for (std::size_t i = 0, range = 0; i < mouse.sensors.size(); ++i) {
            if (mouse.sensors[i].kind != SensorSpec::Kind::range) continue;
            const double expected = mouse.sensors[i].yaw == 0 ? distance : (distance - 0.01) * std::sqrt(2);
            CHECK(seen[range++] == Approx(expected).margin(1e-6));
            ++looked;
        }
        CHECK(looked == 4);
    }
}

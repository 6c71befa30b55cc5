// A world from which a robot is removed, and one that can't continue.
#include <algorithm>
#include <cmath>

#include "tests/unit/sim/try_world.hpp"

using namespace nezumi;
using namespace nezumi::sim;

TEST_CASE("a world that the physics can't continue reports it and stands still", "[sim][world]") {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0, 0, 0.3}, .size = {0.1, 0.1, 0.1}, .mass = 1e6});
    TryWorld w(arena);
    RobotSpec light = mouse_spec();
    light.mass = 1e-9;  // no file can say this
    w.add(light, 0, 0);
    for (int i = 0; i < 1000 && w.world->breakdown() == nullptr; ++i) w.world->step(1);
    REQUIRE(w.world->breakdown() != nullptr);
    CHECK_THAT(w.world->breakdown()->message, Catch::StartsWith("physics: ") && Catch::EndsWith("can be simulated"));
    const Truth before = w.truth();
    w.run(0.1);
    CHECK(w.truth().pose == before.pose);
    CHECK(std::count_if(w.warnings->begin(), w.warnings->end(),
                        [](const auto& text) { return text.find("LCP") != std::string::npos; }) <= 1);
}

TEST_CASE("a removed robot is not seen or touched, and its place is free", "[sim][world]") {
    for (const int others : {0, 12}) {  // few are tested one by one, many are found in a grid
        ArenaSpec arena;
        arena.cylinders.push_back({.at = {0.3, 0, 0.2}, .radius = 0.02, .height = 0.02, .mass = 0.02});
        TryWorld w(arena);
        const RobotSpec mouse = mouse_spec();
        const RobotId looker = w.add(mouse, 0, 0), gone = w.add(mouse, 0.3, 0, 0, "gone");
        for (int i = 0; i < others; ++i) w.add(mouse, 0.5 * i, 3);
        w.run(2);  // the cylinder lies asleep on the other's back
        REQUIRE(w.world->things().front().pose.position.z > 0.06);
        std::vector<double> ranges(mouse.sensors.size());
        const auto nearest = [&] {
            w.bodies[looker]->read_ranges(ranges);
            return *std::min_element(ranges.begin(), ranges.end());
        };
        CHECK(nearest() < 0.3);
        w.world->disturb(gone, {.vx = 0.1});

        w.bodies[gone].reset();
        CHECK(nearest() == INFINITY);
        w.run(1);
        CHECK(w.world->things().front().pose.position.z < 0.05);  // down on the floor
        w.bodies[looker]->set_wheel_speeds({0.2, 0.2});
        w.run(0.8);
        CHECK_FALSE(w.world->collided(looker));
        CHECK(w.truth(looker).pose.position.x > 0.14);
        CHECK(w.world->add_robot("gone", mouse, {{0.3, 0.12}, 0}));  // and, unkept, gone at once
        w.world->step(1);
        CHECK(w.warnings->empty());
    }
}

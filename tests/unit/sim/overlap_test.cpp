// Overlapping things, and robots that leave the arena.
#include "tests/unit/sim/try_world.hpp"

#include <ctime>
#include <string>
#include <vector>

using namespace nezumi;
using namespace nezumi::sim;

TEST_CASE("movable things that overlap something are refused with location and both names", "[sim][world]") {
    const auto refusal = [](const ArenaSpec& arena) {
        const auto made = make_world(arena, {}, {});
        return made ? std::string("made") : describe(made.error());
    };
    const BoxSpec cube{.at = {0.3, 0, 0.05}, .size = {0.1, 0.1, 0.1}, .mass = 0.2, .place = {"arena.lua", 7}};
    const auto with = [&](double dx, double dz, double mass = 0.2) {
        ArenaSpec arena;
        arena.boxes = {cube, cube};
        arena.boxes[1].at.x += dx;
        arena.boxes[1].at.z += dz;
        arena.boxes[0].mass = mass;
        return arena;
    };
    CHECK(refusal(with(0.02, 0)) == "arena.lua:7: box 2 at x = 0.32, y = 0 overlaps box 1 by 80 mm: move one of them");
    CHECK(refusal(with(0.02, 0, 0)).find("box 2 at x = 0.32, y = 0 overlaps box 1 by") != std::string::npos);
    CHECK(refusal(with(0.098, 0)).find("overlaps box 1 by 2 mm") != std::string::npos);
    CHECK(refusal(with(0.0995, 0)) == "made");
    CHECK(refusal(with(0.1, 0)) == "made");
    CHECK(refusal(with(0, 0.1)) == "made");  // a stack
    CHECK(refusal(with(0.03, 0.0995)) == "made");
    CHECK(refusal(with(0, 0.097)).find("overlaps box 1 by 3 mm") != std::string::npos);

    ArenaSpec arena;
    arena.size = Point2D{2, 2};
    arena.cylinders.push_back({.at = {0.99, 0, 0.1}, .radius = 0.05, .height = 0.2, .mass = 1, .place = {"a.lua", 2}});
    CHECK(refusal(arena) ==
          "a.lua:2: cylinder 1 at x = 0.99, y = 0 overlaps the arena's wall by 40 mm: move one of them");
    arena.cylinders[0].mass = 0;  // fixed things may overlap
    CHECK(refusal(arena) == "made");

    arena = {};
    arena.boxes.assign(2000, cube);
    CHECK(refusal(arena).find("arena.lua:7: box 2000 at x = 0.3, y = 0 overlaps box ") == 0);
}

TEST_CASE("a step ends with any number of overlaps, and one warning is given", "[sim][world]") {
    ArenaSpec arena;
    // So thin that they may all be in one place.
    const BoxSpec plate{.at = {0, 0, 0.0004}, .size = {0.2, 0.2, 0.0008}, .mass = 0.01};
    arena.boxes.assign(300, plate);
    TryWorld heap(arena);
    heap.run(0.02);
    CHECK(heap.world->breakdown() == nullptr);
    CHECK(*heap.warnings ==
          std::vector<std::string>{
              "physics: too many shapes overlap: a step has no room for all contacts: some are ignored"});

    // Touches nothing that moves, but 400 pillars.
    arena = {};
    for (int x = 0; x < 20; ++x) {
        for (int y = 0; y < 20; ++y)
            arena.boxes.push_back({.at = {0.05 * x, 0.05 * y, 0.05}, .size = {0.02, 0.02, 0.1}});
    }
    arena.boxes.push_back({.at = {0.5, 0.5, 0.11}, .size = {1, 1, 0.02}, .mass = 1});
    TryWorld table(arena);
    const std::clock_t began = std::clock();
    table.run(0.1);
    CHECK(static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC < 10);
    CHECK(table.world->things().back().pose.position.z == Approx(0.11).margin(2e-3));
}

TEST_CASE("a robot that leaves the arena is reported once", "[sim][world]") {
    ArenaSpec arena;
    arena.size = Point2D{1, 1};
    arena.border->height = 0.003;
    TryWorld w(arena);
    w.add(mouse_spec(), 0, 0, 0, "mouse");
    w.add(mouse_spec(), 0, 0.3, 0, "other");
    w.bodies[0]->set_wheel_speeds({0.5, 0.5});
    w.run(0.8);
    CHECK(w.warnings->empty());
    w.run(1.2);
    CHECK(w.truth().pose.position.x > 0.6);
    const std::string left = "physics: 'mouse' has left the arena of 1 x 1 m, over its border (reported once)";
    CHECK(*w.warnings == std::vector<std::string>{left});
    REQUIRE(w.world->teleport(0, {{0, 0}, 0}));
    w.run(2);
    CHECK(w.truth().pose.position.x > 0.6);
    CHECK(*w.warnings == std::vector<std::string>{left});
}

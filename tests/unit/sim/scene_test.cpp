// Searches by place: fixed shapes and movers, few of them and many.
#include "sim/scene.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace nezumi::sim;

namespace {

Shape disc(double x, double y) { return {Shape::Kind::cylinder, {x, y, 0.05}, Rotation::Identity(), {0.1, 0.1, 0.05}}; }

std::vector<Scene::Index> movers_near(const Scene& scene, double x, double y, double reach,
                                      Scene::Index except = Scene::nobody) {
    std::vector<Scene::Index> found;
    scene.for_each_mover_near(x, y, reach, except, [&](Scene::Index i, const Shape&) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    return found;
}

// A row of discs 1 m apart: 4 are tested one by one, 40 are found in a grid.
Scene row(int count) {
    Scene scene;
    for (int i = 0; i < count; ++i) scene.add_mover(disc(i, 0), 0.1);
    scene.refresh();
    return scene;
}

using Found = std::vector<Scene::Index>;

}  // namespace

TEST_CASE("a search finds movers within reach, except the searching one", "[sim][scene]") {
    for (const int count : {4, 40}) {
        INFO(count << " movers");
        const Scene scene = row(count);
        CHECK(movers_near(scene, 2, 0, 0.89) == Found{2});
        CHECK(movers_near(scene, 2, 0, 0.91) == Found{1, 2, 3});
        CHECK(movers_near(scene, 2, 0, 0.91, 2) == Found{1, 3});
        CHECK(movers_near(scene, 2, 0.5, 0.39).empty());
        CHECK(movers_near(scene, 2, 0.5, 0.41) == Found{2});
    }
}

TEST_CASE("a search finds movers of any size, also of that of a grid cell", "[sim][scene]") {
    for (const int count : {4, 40}) {
        for (const double reach : {0.3, 0.5, 0.51, 2.0}) {
            CAPTURE(count, reach);
            Scene scene = row(count);
            const Scene::Index large = scene.add_mover(disc(1, -3), reach);
            scene.refresh();
            CHECK(movers_near(scene, 1, -3, 0.1) == Found{large});
        }
    }
}

TEST_CASE("a search finds a mover at its place of the last refresh", "[sim][scene]") {
    for (const int count : {4, 40}) {
        INFO(count << " movers");
        Scene scene = row(count);
        scene.mover(1).centre.y() = 5;
        CHECK(movers_near(scene, 1, 0, 0.1) == Found{1});
        scene.refresh();
        CHECK(movers_near(scene, 1, 0, 0.1).empty());
        CHECK(movers_near(scene, 1, 5, 0.1) == Found{1});
    }
}

TEST_CASE("no search finds a removed mover, before and after a refresh", "[sim][scene]") {
    for (const int count : {4, 40}) {
        INFO(count << " movers");
        Scene scene = row(count);
        scene.remove_mover(1);
        for (const bool refreshed : {false, true}) {
            INFO((refreshed ? "refreshed" : "at once"));
            CHECK(movers_near(scene, 1, 0, 0.95) == Found{0, 2});
            CHECK(movers_near(scene, 1, 0, 1000).size() == static_cast<std::size_t>(count) - 1);
            scene.refresh();
        }
    }
}

TEST_CASE("a search finds a mover too large for the grid by its whole reach", "[sim][scene]") {
    for (const int count : {4, 40}) {
        INFO(count << " movers");
        Scene scene = row(count);
        const Scene::Index large = scene.add_mover(disc(0, 10), 5);
        scene.refresh();
        CHECK(movers_near(scene, 0, 4.95, 0.1) == Found{large});
        CHECK(movers_near(scene, 0, 4.85, 0.1).empty());
    }
}

// Searches the scene around every mover.
#include "sim/neighbour_lists.hpp"

#include <algorithm>

namespace nezumi::sim {
namespace {

// Returns true if there is a neighbour.
bool list_about(const Scene& scene, Scene::Index mover, const BodyView& body, double reach, Neighbours& near) {
    const double x = body.p[0], y = body.p[1];
    near.fixed.clear();
    near.movers.clear();
    scene.for_each_fixed_near(x, y, reach, [&](Scene::Index i, const Shape& shape) {
        if (distance_from_above(shape, x, y) <= reach) near.fixed.push_back(i);
    });
    scene.for_each_mover_near(x, y, reach, mover, [&](Scene::Index i, const Shape&) { near.movers.push_back(i); });
    // Sorted in the order of adding and without repeats, so that the grid has no influence.
    std::sort(near.fixed.begin(), near.fixed.end());
    near.fixed.erase(std::unique(near.fixed.begin(), near.fixed.end()), near.fixed.end());
    std::sort(near.movers.begin(), near.movers.end());
    return !near.fixed.empty() || !near.movers.empty();
}

}  // namespace

void NeighbourLists::list(const Scene& scene, Movers& movers) {
    may_travel_ = skin / 2;
    for (Thing& thing : movers.things) {
        list_about(scene, thing.mover, thing.body, scene.movers()[thing.mover].reach() + skin, thing.near);
    }
    for (SimRobot& robot : movers.robots) {
        robot.has_neighbours =
            !robot.gone && list_about(scene, robot.mover, robot.body, robot.model->reach + skin, robot.near);
    }
}

}  // namespace nezumi::sim

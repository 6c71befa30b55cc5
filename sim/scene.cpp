// Fills the grids of a scene.
#include "sim/scene.hpp"

#include <limits>
#include <utility>

namespace nezumi::sim {

Scene::Index Scene::add_fixed(const Shape& shape) {
    const Index index = static_cast<Index>(fixed_.size());
    fixed_.push_back(shape);
    const Rotation& r = shape.rotation;
    const bool box = shape.kind == Shape::Kind::box;
    const double x = box ? std::abs(r(0, 0)) * shape.half.x() + std::abs(r(0, 1)) * shape.half.y() +
                               std::abs(r(0, 2)) * shape.half.z()
                         : shape.half.x() + std::abs(r(0, 2)) * shape.half.z();
    const double y = box ? std::abs(r(1, 0)) * shape.half.x() + std::abs(r(1, 1)) * shape.half.y() +
                               std::abs(r(1, 2)) * shape.half.z()
                         : shape.half.x() + std::abs(r(1, 2)) * shape.half.z();
    const Bounds bounds{shape.centre.x() - x, shape.centre.x() + x, shape.centre.y() - y, shape.centre.y() + y};
    bounds_.push_back(bounds);

    const double columns = (bounds.max_x - bounds.min_x) / cell_size + 2,
                 rows = (bounds.max_y - bounds.min_y) / cell_size + 2;
    if (!(columns * rows <= most_cells)) {
        large_fixed_.push_back(index);
        return index;
    }
    for (auto column = fixed_grid_.index(bounds.min_x); column <= fixed_grid_.index(bounds.max_x); ++column) {
        for (auto row = fixed_grid_.index(bounds.min_y); row <= fixed_grid_.index(bounds.max_y); ++row) {
            const double half = cell_size / 2;
            // The bounding rectangle of a slanting wall covers many cells far from the wall.
            if (distance_from_above(shape, column * cell_size + half, row * cell_size + half) <= cell_size * 0.7072) {
                fixed_grid_.insert_in_cell(index, column, row);
            }
        }
    }
    return index;
}

void Scene::move_fixed(Index index, const Shape& shape) {
    std::vector<Shape> shapes = std::move(fixed_);
    shapes[index] = shape;
    fixed_.clear();
    bounds_.clear();
    large_fixed_.clear();
    fixed_grid_.clear();
    for (const Shape& each : shapes) add_fixed(each);
}

Scene::Index Scene::add_mover(const Shape& shape, double reach) {
    const Index index = static_cast<Index>(movers_.size());
    movers_.push_back(shape);
    spots_.push_back({shape.centre.x(), shape.centre.y(), reach});
    if (spots_.back().reach > large_reach) {
        large_movers_.push_back(index);
    } else {
        largest_reach_ = std::max(largest_reach_, spots_.back().reach);
    }
    keep(index);
    return index;
}

void Scene::remove_mover(Index index) {
    // At infinity no search finds the mover; the grid drops it at the next refresh.
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    movers_[index].centre = {nowhere, nowhere, 0};
    spots_[index].x = spots_[index].y = nowhere;
}

void Scene::keep(Index mover) {
    const Spot& spot = spots_[mover];
    if (spot.reach <= large_reach) mover_grid_.insert(mover, spot.x, spot.y);
}

void Scene::refresh() {
    for (std::size_t i = 0; i < movers_.size(); ++i) {
        spots_[i].x = movers_[i].centre.x();
        spots_[i].y = movers_[i].centre.y();
    }
    if (movers_.size() <= few) return;
    mover_grid_.clear();
    for (Index i = 0; i < movers_.size(); ++i) keep(i);
}

}  // namespace nezumi::sim

// Casts a fan of rays: first selects the near shapes, then tests each ray.
#include "sim/ray_caster.hpp"

#include <algorithm>
#include <cassert>

namespace nezumi::sim {
namespace {

// True if a ray can hit a shape that, seen from above, lies within `reach` of (x, y) relative to the ray's start.
bool may_meet(double x, double y, double reach, const Vec3& direction, double range) {
    const double along = x * direction.x() + y * direction.y();
    const double flat = direction.x() * direction.x() + direction.y() * direction.y();
    // The ray's nearest point to the shape's axis. A shape behind the start can still contain the start.
    const double t = flat > 1e-12 ? std::clamp(along / flat, 0.0, range) : 0.0;
    const double dx = x - t * direction.x(), dy = y - t * direction.y();
    return dx * dx + dy * dy <= reach * reach;
}

void cast_at(const Shape& shape, double reach, const RayFan& fan, const Vec3& centre, const Rotation& rotation,
             std::span<double> distances, std::span<const std::uint8_t> due) {
    for (const RayFan::RayFrom& ray : fan.rays) {
        if (!due.empty() && due[ray.sensor] == 0) continue;
        const Vec3 from = centre + rotate(rotation, ray.from);
        const Vec3 direction = rotate(rotation, ray.direction);
        double& nearest = distances[ray.sensor];
        const double range = std::min(ray.range, nearest);
        if (!may_meet(shape.centre.x() - from.x(), shape.centre.y() - from.y(), reach, direction, range)) continue;
        nearest = std::min(nearest, cast_ray(shape, from, direction, range));
    }
}

}  // namespace

void RayFan::add(const RayFrom& ray) {
    rays.push_back(ray);
    sensors = std::max(sensors, ray.sensor + 1);
    reach = std::max(reach, ray.from.norm() + ray.range);
}

void cast_rays(const Scene& scene, const RayFan& fan, const Vec3& centre, const Rotation& rotation, Scene::Index self,
               std::span<double> distances, std::span<const std::uint8_t> due) {
    assert(distances.size() >= fan.sensors);
    std::fill(distances.begin(), distances.end(), nothing);
    scene.for_each_fixed_near(centre.x(), centre.y(), fan.reach, [&](Scene::Index, const Shape& shape) {
        if (distance_from_above(shape, centre.x(), centre.y()) > fan.reach) return;
        cast_at(shape, shape.reach(), fan, centre, rotation, distances, due);
    });
    scene.for_each_mover_near(centre.x(), centre.y(), fan.reach, self, [&](Scene::Index, const Shape& shape) {
        cast_at(shape, shape.reach(), fan, centre, rotation, distances, due);
    });
}

double cast_ray(const Scene& scene, const Vec3& from, const Vec3& direction, double range, Scene::Index self) {
    double nearest = nothing;
    const auto look = [&](Scene::Index, const Shape& shape) {
        nearest = std::min(nearest, cast_ray(shape, from, direction, std::min(range, nearest)));
    };
    scene.for_each_fixed_near(from.x(), from.y(), range, look);
    scene.for_each_mover_near(from.x(), from.y(), range, self, look);
    return nearest;
}

bool is_clear(const Scene& scene, const Vec3& from, const Vec3& to, Scene::Index self, Scene::Index other) {
    const double range = (to - from).norm();
    if (range < 1e-9) return true;
    const Vec3 direction = (to - from) / range;
    const Vec3 middle = (from + to) / 2;
    bool clear = true;
    const auto look = [&](Scene::Index, const Shape& shape) {
        if (!clear ||
            !may_meet(shape.centre.x() - from.x(), shape.centre.y() - from.y(), shape.reach(), direction, range))
            return;
        clear = cast_ray(shape, from, direction, range) >= nothing;
    };
    scene.for_each_fixed_near(middle.x(), middle.y(), range / 2, look);
    scene.for_each_mover_near(middle.x(), middle.y(), range / 2, self, [&](Scene::Index index, const Shape& shape) {
        if (index != other) look(index, shape);
    });
    return clear;
}

}  // namespace nezumi::sim

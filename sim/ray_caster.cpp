// Casts a fan of rays: first selects the near shapes, then tests each ray.
#include "sim/ray_caster.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

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

// A fan of rays at the pose of a robot, and the distances that the rays measure.
class CastFan {
public:
    CastFan(const RayFan& fan, const Vec3& centre, const Rotation& rotation, std::span<double> distances,
            std::span<const std::uint8_t> due)
        : fan_(fan), centre_(centre), rotation_(rotation), distances_(distances), due_(due) {}

    bool is_due(const RayFan::RayFrom& ray) const { return due_.empty() || due_[ray.sensor] != 0; }

    // Radius [m] of an upright cylinder about the centre that contains all rays that are due.
    double reach() const {
        if (due_.empty()) return fan_.reach;
        double reach = 0;
        for (const RayFan::RayFrom& ray : fan_.rays) {
            if (is_due(ray)) reach = std::max(reach, ray.reach);
        }
        return reach;
    }

    void cast_at(const Shape& shape) {
        const double reach = shape.reach();
        std::size_t next = 0;
        for (const RayFan::Scan& scan : fan_.scans) {
            cast_at(shape, reach, next, scan.begin);
            cast_at(shape, reach, scan);
            next = scan.end;
        }
        cast_at(shape, reach, next, fan_.rays.size());
    }

private:
    // Casts only those rays of a scan that may meet the ball about the shape's centre.
    void cast_at(const Shape& shape, double reach, const RayFan::Scan& scan) {
        if (!is_due(fan_.rays[scan.begin])) return;
        const Vec3 to = rotate_back(rotation_, shape.centre - centre_) - fan_.rays[scan.begin].from;
        const double flat = std::hypot(to.x(), to.y());
        if (flat <= reach) return cast_at(shape, reach, scan.begin, scan.end);
        constexpr double margin = 0.01;  // of a step, more than errors of rounding
        const double turn = 2 * std::numbers::pi / scan.step;
        const double half = std::asin(reach / flat) / scan.step + margin;
        const double middle = (std::atan2(to.y(), to.x()) - scan.first) / scan.step;
        const double last = static_cast<double>(scan.end - scan.begin) - 1;
        // The same direction one turn earlier or later may be within the scan too.
        for (double at = middle - turn * std::floor((middle + half) / turn); at - half <= last; at += turn) {
            const double low = std::max(0.0, std::ceil(at - half)), high = std::min(last, std::floor(at + half));
            if (low > high) continue;
            cast_at(shape, reach, scan.begin + static_cast<std::size_t>(low),
                    scan.begin + static_cast<std::size_t>(high) + 1);
        }
    }

    void cast_at(const Shape& shape, double reach, std::size_t begin, std::size_t end) {
        for (const RayFan::RayFrom& ray : std::span(fan_.rays).subspan(begin, end - begin)) {
            if (!is_due(ray)) continue;
            const Vec3 from = centre_ + rotate(rotation_, ray.from);
            const Vec3 direction = rotate(rotation_, ray.direction);
            double& nearest = distances_[ray.sensor];
            const double range = std::min(ray.range, nearest);
            if (!may_meet(shape.centre.x() - from.x(), shape.centre.y() - from.y(), reach, direction, range)) continue;
            nearest = std::min(nearest, cast_ray(shape, from, direction, range));
        }
    }

    const RayFan& fan_;
    const Vec3& centre_;
    const Rotation& rotation_;
    std::span<double> distances_;
    std::span<const std::uint8_t> due_;
};

}  // namespace

void RayFan::add(const RayFrom& ray) {
    rays.push_back(ray);
    rays.back().reach = ray.from.norm() + ray.range;
    sensors = std::max(sensors, ray.sensor + 1);
    reach = std::max(reach, rays.back().reach);
}

void RayFan::add_scan(RayFrom ray, double first, double step, std::size_t count) {
    scans.push_back({rays.size(), rays.size() + count, first, step});
    for (std::size_t k = 0; k < count; ++k) {
        const double angle = first + step * static_cast<double>(k);
        ray.direction = {std::cos(angle), std::sin(angle), 0};
        add(ray);
        ++ray.sensor;
    }
}

void cast_rays(const Scene& scene, const RayFan& fan, const Vec3& centre, const Rotation& rotation, Scene::Index self,
               std::span<double> distances, std::span<const std::uint8_t> due) {
    assert(distances.size() >= fan.sensors);
    std::fill(distances.begin(), distances.end(), nothing);
    CastFan cast(fan, centre, rotation, distances, due);
    const double reach = cast.reach();
    scene.for_each_fixed_near(centre.x(), centre.y(), reach, [&](Scene::Index, const Shape& shape) {
        if (distance_from_above(shape, centre.x(), centre.y()) <= reach) cast.cast_at(shape);
    });
    scene.for_each_mover_near(centre.x(), centre.y(), reach, self,
                              [&](Scene::Index, const Shape& shape) { cast.cast_at(shape); });
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

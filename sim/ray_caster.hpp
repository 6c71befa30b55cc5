// Casts all rays of a robot at once and finds the first hit of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scene.hpp"

namespace nezumi::sim {

/// The rays of one robot in its own frame, with the origin at its centre.
struct RayFan {
    struct RayFrom {
        Vec3 from = Vec3::Zero();        ///< [m]
        Vec3 direction = Vec3::UnitX();  ///< a unit vector
        double range = 0;                ///< [m]
        std::size_t sensor = 0;          ///< the index of its distance; several rays of one sensor give the nearest hit
        double reach = 0;  ///< [m] radius of an upright cylinder about the centre that contains the ray; set by `add`
    };
    /// Rays next to each other that start at one point, in a horizontal plane at equal angles, as those of a scanner.
    struct Scan {
        std::size_t begin = 0, end = 0;  ///< of the rays
        double first = 0, step = 0;      ///< [rad] the angle of the first ray, and from each ray to the next one
    };
    std::vector<RayFrom> rays;
    std::vector<Scan> scans;  ///< only the rays towards a shape are tested with it
    std::size_t sensors = 0;  ///< the number of distances
    double reach = 0;         ///< [m] radius of an upright cylinder about the centre that contains all rays

    /// Adds a ray.
    void add(const RayFrom& ray);
    /// Adds `count` rays from the point of `ray`, at the angles `first`, `first + step`, ..., each for the next sensor.
    void add_scan(RayFrom ray, double first, double step, std::size_t count);
};

/// Computes for each sensor the distance [m] to the first object that its rays hit, or `nothing`. The fan is
/// at `centre`, rotated by `rotation`. Rays ignore the robot `self`, and the floor: a robot that pitches forward while
/// it brakes would see it as a wall. Skips sensors whose `due` is 0; an empty `due` skips none. Depends on the poses of
/// the scene's last refresh and nothing else.
void cast_rays(const Scene& scene, const RayFan& fan, const Vec3& centre, const Rotation& rotation, Scene::Index self,
               std::span<double> distances, std::span<const std::uint8_t> due = {});

/// Returns the distance of a single ray in the world frame, as above.
double cast_ray(const Scene& scene, const Vec3& from, const Vec3& direction, double range, Scene::Index self);

/// Whether nothing is between two points of the world frame, apart from these two movers. The floor does not count.
bool is_clear(const Scene& scene, const Vec3& from, const Vec3& to, Scene::Index self, Scene::Index other);

}  // namespace nezumi::sim

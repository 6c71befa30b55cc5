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
    };
    std::vector<RayFrom> rays;
    std::size_t sensors = 0;  ///< the number of distances
    double reach = 0;         ///< [m] radius of an upright cylinder about the centre that contains all rays

    /// Adds a ray.
    void add(const RayFrom& ray);
};

/// Writes, for each sensor of the fan, the distance [m] to the first thing its rays meet, or `nothing`. The fan sits
/// at `centre`, turned by `rotation`; the mover `self` is not seen. The floor is not seen: a robot that nods while it
/// brakes would take it for a wall. Sensors for which `due` says 0 are left out; empty: none are. Depends on the poses
/// of the scene's last refresh and nothing else.
void cast_rays(const Scene& scene, const RayFan& fan, const Vec3& centre, const Rotation& rotation, Scene::Index self,
               std::span<double> distances, std::span<const std::uint8_t> due = {});

/// Returns the distance of a single ray in the world frame, as above.
double cast_ray(const Scene& scene, const Vec3& from, const Vec3& direction, double range, Scene::Index self);

/// Whether nothing is between two points of the world frame, apart from these two movers. The floor does not count.
bool is_clear(const Scene& scene, const Vec3& from, const Vec3& to, Scene::Index self, Scene::Index other);

}  // namespace nezumi::sim

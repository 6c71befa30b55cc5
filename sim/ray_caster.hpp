// All rays of a robot at once: the first thing that each meets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/scene.hpp"

namespace nezumi::sim {

/// The rays of one robot in its own frame, whose origin is its centre.
struct RayFan {
    struct RayFrom {
        Vec3 from = Vec3::Zero();        ///< [m]
        Vec3 direction = Vec3::UnitX();  ///< a unit vector
        double range = 0;                ///< [m]
        std::size_t sensor = 0;          ///< which distance it is measured for; of several rays the nearest hit counts
    };
    std::vector<RayFrom> rays;
    std::size_t sensors = 0;  ///< how many distances there are
    double reach = 0;         ///< [m] none of the rays leaves the upright cylinder of this radius about the centre

    /// Adds a ray.
    void add(const RayFrom& ray);
};

/// Writes, for each sensor of the fan, the distance [m] to the first thing its rays meet, or `nothing`. The fan sits
/// at `centre`, turned by `rotation`; the mover `self` is not seen. The floor is not seen: a robot that nods while it
/// brakes would take it for a wall. Sensors for which `due` says 0 are left out; empty: none are. Depends on the poses
/// of the scene's last refresh and nothing else.
void cast_rays(const Scene& scene, const RayFan& fan, const Vec3& centre, const Rotation& rotation, Scene::Index self,
               std::span<double> distances, std::span<const std::uint8_t> due = {});

/// Distance of a single ray in the world, as above.
double cast_ray(const Scene& scene, const Vec3& from, const Vec3& direction, double range, Scene::Index self);

}  // namespace nezumi::sim

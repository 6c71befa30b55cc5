// A source of pictures, a simulation or a device: its position, settings and intrinsics.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {

/// The intrinsics of a camera without distortion, with the optical axis in the middle of the picture; `field_of_view`
/// [rad] is horizontal.
CameraIntrinsics pinhole(int width, int height, double field_of_view);

/// Settings of a camera.
struct CameraSettings {
    std::string device;  ///< device of a real camera; "": the first one found
    int width = 640;     ///< [px]
    int height = 480;    ///< [px]
    double frame_rate = 30;
    double field_of_view = 0;                       ///< [rad] horizontal
    double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;  ///< distortion, as in `CameraIntrinsics`
    double k4 = 0, k5 = 0, k6 = 0;                  ///< more of the distortion
    bool color = true;                              ///< "rgb8", else "gray8"
    double noise = 0;                               ///< [0..255] standard deviation of a pixel's value
    double blur = 0;                                ///< [px] standard deviation of a Gaussian
    std::uint64_t seed = 0;                         ///< of the noise
    double fx = 0, fy = 0, cx = 0, cy = 0;          ///< as in `CameraIntrinsics`, instead of `field_of_view`; 0: unused
    bool undistort = false;                         ///< removes the distortion from its pictures
    std::string pixel_format;                       ///< that a real camera sends, four letters; "": the camera's choice

    /// The intrinsics of the raw pictures: by size and field of view, or by `fx` to `cy`, with distortion.
    CameraIntrinsics raw_intrinsics() const;
    /// The intrinsics of the published pictures: the raw ones, but without distortion if `undistort` is set.
    CameraIntrinsics intrinsics() const;
};

/// The position of a camera. Camera and body frame have x forward, y left, z up.
struct CameraMount {
    std::string robot;  ///< robot that carries the camera; "": the camera stands in the arena
    Point3D at{};       ///< [m] in the robot's body frame, or in the world
    double yaw = 0;     ///< [rad]
    double pitch = 0;   ///< [rad] after the yaw; positive looks down
};

/// A source of pictures: a simulation or a device.
class CameraSource {
public:
    virtual ~CameraSource() = default;
    /// Intrinsics of all pictures of this source; unknown if `fx` is 0.
    virtual CameraIntrinsics intrinsics() const = 0;
    /// Whether this is a device that takes pictures by itself. Then `expose` is called in every tick, and `develop` is
    /// fast.
    virtual bool is_device() const { return false; }
    /// Stores the present view; fast, in the ticking thread. Returns the time [s] of the picture: now in a simulation;
    /// for a device, the time of the newest picture, or nothing if there is no new one.
    virtual std::optional<double> expose(const Time& now) = 0;
    /// Makes the picture of the last exposure; slow, in any thread, never at the same time as `expose`.
    virtual void develop(CameraImage& image) = 0;
    /// The faults since the last call: one line each, with what to do.
    virtual std::vector<std::string> take_faults() { return {}; }
};

/// The largest and the smallest size of pictures [px], for width and height.
inline constexpr int least_picture = 16, largest_picture = 4096;

}  // namespace nezumi

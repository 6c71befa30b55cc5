// What takes pictures, a simulation or a device: where it looks from, how it is set, and its pinhole.
#pragma once

#include <cstdint>
#include <string>

#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {

/// A pinhole: where a point before the camera appears. A point x to the right, y down and z ahead [m] is seen at column
/// `cx + fx * x / z` and row `cy + fy * y / z`; the centre of the first pixel is at (0, 0).
struct Intrinsics {
    double fx = 0;  ///< [px] focal length along a row
    double fy = 0;  ///< [px] along a column
    double cx = 0;  ///< [px] column of the optical axis
    double cy = 0;  ///< [px] row of the optical axis

    /// A pinhole that looks through the middle of the picture; `field_of_view` [rad] is that of a row.
    static Intrinsics of(int width, int height, double field_of_view);
    bool operator==(const Intrinsics&) const = default;
};

/// How a camera is set.
struct CameraSettings {
    std::string device;  ///< of a real camera; "" for the first
    int width = 640;     ///< [px]
    int height = 480;    ///< [px]
    double frame_rate = 30;
    double field_of_view = 0;  ///< [rad] of a row
    bool color = true;         ///< "rgb8", else "gray8"
    double noise = 0;          ///< standard deviation of a pixel's value, which goes from 0 to 255
    double blur = 0;           ///< [px] standard deviation of a Gaussian
    std::uint64_t seed = 0;    ///< of the noise
};

/// Where a camera looks from. Camera and body frame have x forward, y left, z up.
struct CameraMount {
    std::string robot;  ///< that carries it; "": it stands in the arena
    Point3D at{};       ///< [m] in the robot's body frame, or in the world
    double yaw = 0;     ///< [rad]
    double pitch = 0;   ///< [rad] after the yaw; positive looks down
};

/// What takes the pictures: a simulation or a device.
class CameraSource {
public:
    virtual ~CameraSource() = default;
    /// Keeps what there is to see now; quick, on the thread that ticks.
    virtual void expose(const Time& now) = 0;
    /// Makes the picture of the last exposure; slow, on any thread, never together with `expose`.
    virtual void develop(CameraImage& image) = 0;
};

/// The largest and the smallest picture that a camera makes, by width and height [px].
inline constexpr int least_picture = 16, largest_picture = 4096;

}  // namespace nezumi

// What takes pictures, a simulation or a device: where it looks from, how it is set, how it sees.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/ports/messages.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi {

/// The intrinsics of a camera without distortion that looks through the middle of its picture; `field_of_view` [rad] is
/// that of a row.
CameraIntrinsics pinhole(int width, int height, double field_of_view);

/// How a camera is set.
struct CameraSettings {
    std::string device;  ///< of a real camera; "" for the first
    int width = 640;     ///< [px]
    int height = 480;    ///< [px]
    double frame_rate = 30;
    double field_of_view = 0;                       ///< [rad] of a row
    double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;  ///< distortion, as in `CameraIntrinsics`
    double k4 = 0, k5 = 0, k6 = 0;                  ///< likewise
    bool color = true;                              ///< "rgb8", else "gray8"
    double noise = 0;                               ///< standard deviation of a pixel's value, which goes from 0 to 255
    double blur = 0;                                ///< [px] standard deviation of a Gaussian
    std::uint64_t seed = 0;                         ///< of the noise
    double fx = 0, fy = 0, cx = 0, cy = 0;          ///< as in `CameraIntrinsics`, instead of `field_of_view`; 0: not
    bool undistort = false;                         ///< its pictures are made those of the pinhole
    std::string pixel_format;                       ///< that a real camera sends, four letters; "": what it likes

    /// Of what the camera takes: the pinhole of size and field of view, or of `fx` and its like, with the distortion.
    CameraIntrinsics raw_intrinsics() const;
    /// Of the pictures: the raw ones, without their distortion where that is taken out.
    CameraIntrinsics intrinsics() const;
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
    /// Those of every picture; with an `fx` of 0 unknown.
    virtual CameraIntrinsics intrinsics() const = 0;
    /// Whether it is a device, which takes pictures on its own: `expose` is called in every tick, and `develop` is
    /// quick.
    virtual bool is_device() const { return false; }
    /// Keeps what there is to see now; quick, on the thread that ticks. Returns when [s] that was: now in a simulation.
    /// Of a device it is the newest picture, and when that was exposed; nothing when there is no new one.
    virtual std::optional<double> expose(const Time& now) = 0;
    /// Makes the picture of the last exposure; slow, on any thread, never together with `expose`.
    virtual void develop(CameraImage& image) = 0;
    /// What has failed since the last call: one line for each with what to do about it.
    virtual std::vector<std::string> take_faults() { return {}; }
};

/// The largest and the smallest picture that a camera makes, by width and height [px].
inline constexpr int least_picture = 16, largest_picture = 4096;

}  // namespace nezumi

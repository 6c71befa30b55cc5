// Lens distortion, applied to the picture of a pinhole camera.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi::sim {

/// Stores, for each pixel of the distorted picture, its source in the pinhole picture. The pinhole picture has the size
/// that covers the lens's field of view.
class Distortion {
public:
    /// Fails if a pixel has no source in the pinhole picture, or one far outside: then the distortion folds the
    /// picture.
    static Expected<Distortion> make(const CameraIntrinsics& intrinsics);

    /// The intrinsics of the camera.
    const CameraIntrinsics& intrinsics() const { return intrinsics_; }
    /// The intrinsics of the pinhole picture to be painted.
    const CameraIntrinsics& pinhole() const { return pinhole_; }
    /// Draws the distorted picture from the pinhole picture. Both have `channels` bytes per pixel.
    void apply(std::vector<std::uint8_t>& painted, int channels, std::vector<std::uint8_t>& distorted) const;

private:
    CameraIntrinsics intrinsics_;
    CameraIntrinsics pinhole_;
    // Per pixel, in OpenCV's fixed-point format: its source in the pinhole picture, and the index of its weights.
    std::vector<std::int16_t> places_;
    std::vector<std::uint16_t> weights_;
};

}  // namespace nezumi::sim

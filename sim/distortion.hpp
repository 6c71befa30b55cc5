// The distortion of a camera's lens, put on the picture of a pinhole.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/ports/messages.hpp"

namespace nezumi::sim {

/// For each pixel of the distorted picture, where a pinhole sees the same. The pinhole's picture is larger or smaller:
/// as large as what the lens shows.
class Distortion {
public:
    /// An error when a pixel has no place, or one far out, in a pinhole's picture: the distortion folds it over.
    static Expected<Distortion> make(const CameraIntrinsics& intrinsics);

    /// The pinhole to paint with.
    const CameraIntrinsics& pinhole() const { return pinhole_; }
    /// Draws the distorted picture from the pinhole's, both of `channels` bytes a pixel.
    void apply(std::vector<std::uint8_t>& painted, int channels, std::vector<std::uint8_t>& distorted) const;

private:
    CameraIntrinsics intrinsics_;
    CameraIntrinsics pinhole_;
    // By pixel, in OpenCV's fixed point: where it lies in the pinhole's picture, and the index of its weights.
    std::vector<std::int16_t> places_;
    std::vector<std::uint16_t> weights_;
};

}  // namespace nezumi::sim

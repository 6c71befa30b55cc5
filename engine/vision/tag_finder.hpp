// Finds AprilTags in a grey picture, and their poses.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "engine/ports/messages.hpp"
#include "engine/vision/checked_image.hpp"

namespace nezumi {

struct FoundTag {
    int id = 0;
    /// Position: x forward, y left, z up from the camera [m]. Orientation: roll, pitch and yaw about the same axes; all
    /// 0 for an upright tag that faces the camera. A tag turned to the left (seen from above) has a positive yaw.
    Pose3D pose;
    double edge = 0;  ///< [px] mean edge of its black border in the picture
};

/// Finds tags of one family. Not thread-safe.
class TagFinder {
public:
    /// The names of the families: "36h11", "25h9", "16h5".
    static std::vector<std::string_view> families();

    /// `family` is one of `families()`.
    explicit TagFinder(std::string_view family);
    ~TagFinder();
    TagFinder(TagFinder&&) noexcept;
    TagFinder& operator=(TagFinder&&) noexcept;

    /// Returns the visible tags of the family, the nearest first (of two equally near, the one with the smaller
    /// number). `size` [m] is the edge of their black border: a wrong one scales every position by wrong / right.
    /// Smooths the picture.
    std::vector<FoundTag> find(GrayImage& image, const CameraIntrinsics& intrinsics, double size);

private:
    struct Detector;
    std::unique_ptr<Detector> detector_;
};

}  // namespace nezumi

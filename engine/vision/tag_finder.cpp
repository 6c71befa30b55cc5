// AprilTag's detector, its pose turned into the axes of robots.
#include "engine/vision/tag_finder.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/apriltag_pose.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace nezumi {
namespace {

struct Family {
    std::string_view name;
    apriltag_family_t* (*create)();
    void (*destroy)(apriltag_family_t*);
};
constexpr Family known_families[] = {{"36h11", tag36h11_create, tag36h11_destroy},
                                     {"25h9", tag25h9_create, tag25h9_destroy},
                                     {"16h5", tag16h5_create, tag16h5_destroy}};

// Bits of a tag that may be wrong. Two cost 18 MB for 36h11 and find more tags where there are none.
constexpr int forgiven_bits = 1;
// Half the resolution for finding quads: four times as quick, and the edges are refined in the full picture.
constexpr float decimation = 2;
// AprilTag counts from the corner of the first pixel, our intrinsics from its centre.
constexpr double pixel_offset = 0.5;
// Steps between grey values that count as edges. With its own 5, the noise of a dim picture makes thousands of edges
// and finding tags takes ten times as long.
constexpr int least_contrast = 25;
// [px] Its tiles and its halved picture need some room.
constexpr int least_side = 16;

// A matrix is one block of malloc's; Debian's library keeps its own way to free it to itself.
using Matrix = std::unique_ptr<matd_t, decltype(&std::free)>;
using Detections = std::unique_ptr<zarray_t, decltype(&apriltag_detections_destroy)>;

double edge_of(const apriltag_detection_t& tag) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const double* a = tag.p[i];
        const double* b = tag.p[(i + 1) % 4];
        sum += std::hypot(a[0] - b[0], a[1] - b[1]);
    }
    return sum / 4;
}

// From the camera's axes (x right, y down, z ahead) to the robots' (x ahead, y left, z up).
Pose3D to_robot_axes(const matd_t& r, const matd_t& t) {
    // Row and column i of the robots' axes is +/- row and column `from[i]` of the camera's.
    constexpr int from[] = {2, 0, 1};
    constexpr double sign[] = {1, -1, -1};
    const auto at = [&](int row, int column) {
        return sign[row] * sign[column] * r.data[from[row] * 3 + from[column]];
    };
    Pose3D pose;
    pose.position = {t.data[2], -t.data[0], -t.data[1]};
    pose.orientation = {.r = std::atan2(at(2, 1), at(2, 2)),
                        .p = -std::asin(std::clamp(at(2, 0), -1.0, 1.0)),
                        .y = std::atan2(at(1, 0), at(0, 0))};
    return pose;
}

}  // namespace

struct TagFinder::Detector {
    explicit Detector(const Family& of)
        : destroy_family(of.destroy), family(of.create()), detector(apriltag_detector_create()) {
        apriltag_detector_add_family_bits(detector, family, forgiven_bits);
        detector->quad_decimate = decimation;
        detector->nthreads = 1;
        detector->qtp.min_white_black_diff = least_contrast;
    }
    ~Detector() {
        apriltag_detector_destroy(detector);
        destroy_family(family);
    }
    Detector(const Detector&) = delete;
    Detector& operator=(const Detector&) = delete;

    void (*destroy_family)(apriltag_family_t*);
    apriltag_family_t* family;
    apriltag_detector_t* detector;
};

std::vector<std::string_view> TagFinder::families() {
    std::vector<std::string_view> names;
    for (const Family& family : known_families) names.push_back(family.name);
    return names;
}

TagFinder::TagFinder(std::string_view family) {
    const auto* found = std::find_if(std::begin(known_families), std::end(known_families),
                                     [&](const Family& known) { return known.name == family; });
    assert(found != std::end(known_families));
    detector_ = std::make_unique<Detector>(*found);
}

TagFinder::~TagFinder() = default;
TagFinder::TagFinder(TagFinder&&) noexcept = default;
TagFinder& TagFinder::operator=(TagFinder&&) noexcept = default;

std::vector<FoundTag> TagFinder::find(GrayImage& image, const Intrinsics& intrinsics, double size) {
    std::vector<FoundTag> tags;
    if (std::min(image.width, image.height) < least_side) return tags;
    image_u8_t view{image.width, image.height, image.width, image.pixels.data()};
    const Detections found(apriltag_detector_detect(detector_->detector, &view), apriltag_detections_destroy);
    for (int i = 0; i < zarray_size(found.get()); ++i) {
        apriltag_detection_t* tag = nullptr;
        zarray_get(found.get(), i, static_cast<void*>(&tag));
        apriltag_detection_info_t info{
            tag, size, intrinsics.fx, intrinsics.fy, intrinsics.cx + pixel_offset, intrinsics.cy + pixel_offset};
        apriltag_pose_t pose{};
        estimate_tag_pose(&info, &pose);
        const Matrix rotation(pose.R, std::free), translation(pose.t, std::free);
        tags.push_back({tag->id, to_robot_axes(*rotation, *translation), edge_of(*tag)});
    }
    const auto key = [](const FoundTag& tag) {
        const Point3D& p = tag.pose.position;
        return std::tuple{p.x * p.x + p.y * p.y + p.z * p.z, tag.id};
    };
    std::sort(tags.begin(), tags.end(), [&](const FoundTag& a, const FoundTag& b) { return key(a) < key(b); });
    return tags;
}

}  // namespace nezumi

// AprilTag finds the corners, OpenCV computes the pose, and Eigen converts it to the axes of robots.
#include "engine/vision/tag_finder.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <tuple>

#include "engine/vision/one_thread.hpp"

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

// Bits of a tag that may be wrong. Two cost 18 MB for 36h11 and find more false tags.
constexpr int forgiven_bits = 1;
// Quads are searched at half the resolution: four times as fast, and the edges are refined in the full picture.
constexpr float decimation = 2;
// AprilTag's coordinates start at the corner of the first pixel, those of intrinsics at its centre.
constexpr double pixel_offset = 0.5;
// A noisy picture has thousands of edges, which makes finding tags twenty times slower. So pictures are smoothed by
// this number of pixels, and only larger steps between grey values count (AprilTag's default: 5).
constexpr double tag_smoothing = 0.8;
constexpr int least_contrast = 25;
// [px] The smallest picture: AprilTag's tiles and its halved picture need some room.
constexpr int least_side = 16;

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

// The pose of a tag relative to the camera, both with x right, y down and z ahead; nothing if no pose fits.
struct CameraPose {
    cv::Matx33d rotation;
    cv::Vec3d translation;
};
std::optional<CameraPose> pose_of(const apriltag_detection_t& tag, const CameraIntrinsics& c, double size) {
    const double h = size / 2;
    // The corners, in the order that both IPPE and AprilTag use.
    const std::array<cv::Point3d, 4> corners{{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}}};
    std::array<cv::Point2d, 4> seen;
    for (std::size_t i = 0; i < 4; ++i) seen[i] = {tag.p[i][0] - pixel_offset, tag.p[i][1] - pixel_offset};
    const cv::Matx33d camera(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
    const cv::Vec<double, 8> distortion(c.k1, c.k2, c.p1, c.p2, c.k3, c.k4, c.k5, c.k6);
    // A square looks nearly the same in two poses. The better pose comes first, and is then refined in the picture.
    std::vector<cv::Mat> rotations, translations;
    cv::solvePnPGeneric(corners, seen, camera, distortion, rotations, translations, false, cv::SOLVEPNP_IPPE_SQUARE);
    if (rotations.empty()) return std::nullopt;
    cv::solvePnPRefineLM(corners, seen, camera, distortion, rotations.front(), translations.front());
    CameraPose pose;
    cv::Rodrigues(rotations.front(), pose.rotation);
    pose.translation = translations.front();
    const bool sound = cv::checkRange(pose.rotation) && cv::checkRange(pose.translation) && pose.translation[2] > 0;
    return sound ? std::optional(pose) : std::nullopt;
}

// From the camera's axes (x right, y down, z ahead) to the robots' (x ahead, y left, z up).
Pose3D to_robot_axes(const CameraPose& pose) {
    const Eigen::Matrix3d axes{{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    const Eigen::Matrix3d r = axes * Eigen::Map<const RowMajor>(pose.rotation.val) * axes.transpose();
    const Eigen::Vector3d at = axes * Eigen::Map<const Eigen::Vector3d>(pose.translation.val);
    return {.position = {at.x(), at.y(), at.z()},
            .orientation = {.r = std::atan2(r(2, 1), r(2, 2)),
                            .p = -std::asin(std::clamp(r(2, 0), -1.0, 1.0)),
                            .y = std::atan2(r(1, 0), r(0, 0))}};
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
    use_one_thread();
}

TagFinder::~TagFinder() = default;
TagFinder::TagFinder(TagFinder&&) noexcept = default;
TagFinder& TagFinder::operator=(TagFinder&&) noexcept = default;

std::vector<FoundTag> TagFinder::find(GrayImage& image, const CameraIntrinsics& intrinsics, double size) {
    std::vector<FoundTag> tags;
    if (std::min(image.width, image.height) < least_side) return tags;
    cv::Mat pixels(image.height, image.width, CV_8UC1, image.pixels.data());
    cv::GaussianBlur(pixels, pixels, {}, tag_smoothing);
    image_u8_t view{image.width, image.height, image.width, image.pixels.data()};
    const Detections found(apriltag_detector_detect(detector_->detector, &view), apriltag_detections_destroy);
    for (int i = 0; i < zarray_size(found.get()); ++i) {
        apriltag_detection_t* tag = nullptr;
        zarray_get(found.get(), i, static_cast<void*>(&tag));
        const auto pose = pose_of(*tag, intrinsics, size);
        if (pose) tags.push_back({tag->id, to_robot_axes(*pose), edge_of(*tag)});
    }
    const auto key = [](const FoundTag& tag) {
        const Point3D& p = tag.pose.position;
        return std::tuple{p.x * p.x + p.y * p.y + p.z * p.z, tag.id};
    };
    std::sort(tags.begin(), tags.end(), [&](const FoundTag& a, const FoundTag& b) { return key(a) < key(b); });
    return tags;
}

}  // namespace nezumi

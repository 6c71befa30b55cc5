// Chooses the camera intrinsics for a picture in the tick, and searches the picture for tags in another thread.
#include "engine/vision/marker_detector.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/world/camera_source.hpp"

namespace nezumi {
namespace {

constexpr double usual_field_of_view = 1.0472;  // [rad] the Camera's default

struct Search {
    std::int64_t id;
    double size, yaw_from;
};

// The searched tags, the nearest first.
std::vector<SeenMarker> markers_in(GrayImage& gray, TagFinder& finder, const CameraIntrinsics& intrinsics,
                                   const Search& search) {
    std::vector<SeenMarker> seen;
    for (FoundTag& tag : finder.find(gray, intrinsics, search.size)) {
        if (search.id >= 0 && tag.id != search.id) continue;
        // A small tag looks nearly the same from the left and from the right: its orientation is unknown, so it is 0.
        if (tag.edge < search.yaw_from) tag.pose.orientation = {};
        seen.push_back({tag.id, tag.pose});
    }
    return seen;
}

}  // namespace

MarkerDetector::MarkerDetector(std::string name, bool wait)
    : ImageComponent(std::move(name), "MarkerDetector", wait),
      intrinsics_(add_in_port<CameraIntrinsics>("intrinsics",
                                                "the camera's intrinsics; connected together with a Camera's picture")),
      pos_(add_out_port<Pose3D>("pos",
                                "where the marker is from the camera: x forward, y left, z up; silent while none "
                                "is in sight")),
      visible_(add_out_port<bool>("visible", "whether a marker was in sight, once for each picture")),
      id_(add_out_port<std::int32_t>("id", "the marker's number, together with pos")),
      markers_(add_out_port<std::vector<SeenMarker>>(
          "markers", "all that are in sight, the nearest first; once for each picture")) {
    image_port().set_companion(intrinsics_);
    std::vector<Value> families;
    for (const std::string_view family : TagFinder::families()) families.emplace_back(std::string(family));
    declare({.name = "tag_size",
             .initial = 0.1,
             .min = 0.001,
             .max = 100,
             .unit = "m",
             .doc = "edge of the marker's black border"});
    declare({.name = "family", .initial = families.front(), .doc = "of AprilTags", .choices = families});
    declare({.name = "id",
             .initial = std::int64_t{-1},
             .min = -1,
             .max = 586,
             .doc = "the only marker to look for; -1: all"});
    declare_latency();
    declare(
        {.name = "yaw_from",
         .initial = 30.0,
         .min = 0,
         .max = 10000,
         .unit = "px",
         .doc = "a marker that looks smaller has the orientation 0, 0, 0: it could not be told from its mirror image"});
    declare({.name = "fx",
             .initial = 0.0,
             .min = 0,
             .max = 1e6,
             .unit = "px",
             .doc = "focal length in x, of a camera without distortion; 0: that of the intrinsics"});
    declare({.name = "fy", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: as fx"});
    declare({.name = "cx", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: the middle"});
    declare({.name = "cy", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: the middle"});
    declare({.name = "field_of_view",
             .initial = usual_field_of_view,
             .min = 0.05,
             .max = 2.8,
             .unit = "rad",
             .doc = "horizontal, for pictures without intrinsics while fx is 0"});
}

void MarkerDetector::tell_unknown(std::string what) {
    if (std::exchange(told_, what) != what) log(LogLevel::warn, std::move(what));
}

Expected<CameraIntrinsics> MarkerDetector::intrinsics_for(const GrayImage& image) {
    CameraIntrinsics own = pinhole(image.width, image.height, value<double>("field_of_view"));
    const double fx = value<double>("fx");
    if (fx > 0) {
        const auto given = [&](std::string_view name, double otherwise) {
            const double set = value<double>(name);
            return set > 0 ? set : otherwise;
        };
        own.fx = fx;
        own.fy = given("fy", fx);
        own.cx = given("cx", own.cx);
        own.cy = given("cy", own.cy);
        return own;
    }
    const CameraIntrinsics& told = intrinsics_.latest().data;
    if (!(told.fx > 0)) {
        if (told.width > 0)
            tell_unknown(
                fmt::format("intrinsics: fx = {:g}: the camera is not calibrated. field_of_view = {:g} is used: set "
                            "field_of_view or fx to the camera's value, or calibrate the camera",
                            told.fx, value<double>("field_of_view")));
        return own;
    }
    if (told.width != image.width || told.height != image.height) {
        return failure(fmt::format("{} x {} pixels, but intrinsics for {} x {}", image.width, image.height, told.width,
                                   told.height));
    }
    CameraIntrinsics used = told;
    if (!(told.fy > 0)) {
        tell_unknown(fmt::format("intrinsics: fy = {:g}: fx = {:g} is used instead", told.fy, told.fx));
        used.fy = told.fx;
    }
    return used;
}

Expected<MarkerDetector::DetectionTask> MarkerDetector::detection_task(const CameraImage& image) {
    auto gray = to_gray(image, std::move(picture_.pixels));
    if (!gray) return failure("image: " + gray.error().message);
    picture_ = std::move(*gray);
    const auto intrinsics = intrinsics_for(picture_);
    if (!intrinsics) return failure("image: " + intrinsics.error().message);
    const auto& family = value<std::string>("family");
    if (!finder_ || family != family_) {
        finder_.emplace(family);
        family_ = family;
    }
    const Search search{value<std::int64_t>("id"), value<double>("tag_size"), value<double>("yaw_from")};
    return [this, intrinsics = *intrinsics, search] { return markers_in(picture_, *finder_, intrinsics, search); };
}

void MarkerDetector::publish(const std::vector<SeenMarker>& seen) {
    visible_.write(!seen.empty());
    markers_.write(seen);
    if (seen.empty()) return;
    pos_.write(seen.front().pose);
    id_.write(seen.front().id);
}

}  // namespace nezumi

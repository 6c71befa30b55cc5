// One picture at a time is looked at beside the tick; those that come meanwhile are passed over but for the newest.
#include "engine/vision/marker_detector.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

#include "engine/system/system.hpp"
#include "engine/world/camera_source.hpp"

namespace nezumi {
namespace {

constexpr double usual_field_of_view = 1.0472;  // [rad] the Camera's default

template <class T>
const T& value(const Parameters& parameters, std::string_view name) {
    return std::get<T>(parameters.find(name)->value);
}

struct Search {
    std::int64_t id;
    double size, yaw_from;
};

MarkerSight look(TagFinder& finder, Expected<MarkerDetector::Picture>& picture, const Search& search) {
    if (!picture) return {.tag = {}, .complaint = picture.error().message};
    MarkerSight sight;
    for (FoundTag& tag : finder.find(picture->gray, picture->intrinsics, search.size)) {
        if (search.id >= 0 && tag.id != search.id) continue;
        // A small tag looks nearly the same from the left and from the right: its orientation would flip.
        if (tag.edge < search.yaw_from) tag.pose.orientation = {};
        sight.tag = tag;
        break;
    }
    return sight;
}

}  // namespace

MarkerDetector::MarkerDetector(std::string name, bool wait)
    : Component(std::move(name), "MarkerDetector"),
      wait_(wait),
      image_(add_in_port<CameraImage>("image", "a camera's picture")),
      intrinsics_(add_in_port<CameraIntrinsics>("intrinsics", "the camera's; comes along with a Camera's picture")),
      pos_(add_out_port<Pose3D>("pos",
                                "where the marker is from the camera: x forward, y left, z up; silent while none "
                                "is in sight")),
      visible_(add_out_port<bool>("visible", "whether a marker was in sight, once for each picture")),
      id_(add_out_port<std::int32_t>("id", "the marker's number, together with pos")) {
    image_.set_companion(intrinsics_);
    const auto declare = [this](ParameterSpec spec) {
        const auto ok = parameters_.declare(std::move(spec));
        assert(ok);
        static_cast<void>(ok);
    };
    std::vector<ParameterValue> families;
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
             .doc = "the only marker to look for; -1: the nearest of all"});
    declare({.name = "latency",
             .initial = 0.02,
             .min = 0,
             .max = 10,
             .unit = "s",
             .doc = "from the picture to the position, in simulated time"});
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
             .doc = "focal length along a row, of a camera without distortion; 0: that of the intrinsics"});
    declare({.name = "fy", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: as fx"});
    declare({.name = "cx", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: the middle"});
    declare({.name = "cy", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: the middle"});
    declare({.name = "field_of_view",
             .initial = usual_field_of_view,
             .min = 0.05,
             .max = 2.8,
             .unit = "rad",
             .doc = "of a row, for pictures without intrinsics while fx is 0"});
}

Expected<void> MarkerDetector::on_activated() {
    sight_.finish();
    complained_ = false;
    return {};
}

Expected<void> MarkerDetector::on_deactivated() {
    sight_.finish();
    return {};
}

Expected<CameraIntrinsics> MarkerDetector::intrinsics_for(const GrayImage& image) const {
    CameraIntrinsics own = pinhole(image.width, image.height, value<double>(parameters_, "field_of_view"));
    const double fx = value<double>(parameters_, "fx");
    if (fx > 0) {
        const auto given = [&](std::string_view name, double otherwise) {
            const double set = value<double>(parameters_, name);
            return set > 0 ? set : otherwise;
        };
        own.fx = fx;
        own.fy = given("fy", fx);
        own.cx = given("cx", own.cx);
        own.cy = given("cy", own.cy);
        return own;
    }
    const CameraIntrinsics& told = intrinsics_.latest().data;
    if (!(told.fx > 0)) return own;
    if (told.width != image.width || told.height != image.height) {
        return failure(fmt::format("{} x {} pixels, but intrinsics for {} x {}", image.width, image.height, told.width,
                                   told.height));
    }
    return told;
}

// Grey is a third of what would have to be copied else.
Expected<MarkerDetector::Picture> MarkerDetector::picture() {
    auto gray = to_gray(image_.read());
    if (!gray) return Unexpected(gray.error());
    auto intrinsics = intrinsics_for(*gray);
    if (!intrinsics) return Unexpected(intrinsics.error());
    return Picture{std::move(*gray), *intrinsics};
}

void MarkerDetector::start() {
    const auto& family = value<std::string>(parameters_, "family");
    if (!finder_ || family != family_) {
        finder_.emplace(family);
        family_ = family;
    }
    const Search search{value<std::int64_t>(parameters_, "id"), value<double>(parameters_, "tag_size"),
                        value<double>(parameters_, "yaw_from")};
    sight_.start(
        now(), value<double>(parameters_, "latency"),
        [finder = &*finder_, picture = picture(), search]() mutable { return look(*finder, picture, search); });
}

void MarkerDetector::publish(const MarkerSight& sight) {
    if (!sight.complaint.empty() && !complained_)
        log(LogLevel::warn, fmt::format("image: {}: nothing can be seen in it", sight.complaint));
    complained_ = !sight.complaint.empty();
    visible_.write(sight.tag.has_value());
    if (!sight.tag) return;
    pos_.write(sight.tag->pose);
    id_.write(sight.tag->id);
}

Expected<void> MarkerDetector::take_sight() {
    const auto sight = sight_.take(now(), wait_);
    if (!sight) return {};
    if (!*sight) return failure("the picture could not be searched: " + sight->error().message);
    publish(**sight);
    return {};
}

Expected<void> MarkerDetector::on_execute() {
    if (auto ok = take_sight(); !ok) return ok;
    if (sight_.busy() || !image_.is_new()) return {};
    start();
    return take_sight();
}

Expected<std::unique_ptr<Component>> make_marker_detector(const ComponentEntry& entry, System& system) {
    if (!entry.on.empty()) {
        return failure(fmt::format("component '{}': a MarkerDetector is not mounted on a robot: 'on' is for its Camera",
                                   entry.name),
                       entry.place);
    }
    return std::make_unique<MarkerDetector>(entry.name, !system.settings().real_time);
}

}  // namespace nezumi

// One picture at a time is looked at beside the tick; those that come meanwhile are passed over but for the newest.
#include "engine/vision/marker_detector.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

#include "engine/system/system.hpp"

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

MarkerSight look(TagFinder& finder, const CameraImage& image, const Intrinsics& lens, const Search& search) {
    auto gray = to_gray(image);
    if (!gray) return {.tag = {}, .complaint = gray.error().message};
    MarkerSight sight;
    for (FoundTag& tag : finder.find(*gray, lens, search.size)) {
        if (search.id >= 0 && tag.id != search.id) continue;
        // A small tag looks nearly the same from the left and from the right: its orientation would flip.
        if (tag.edge < search.yaw_from) tag.pose.orientation = {};
        sight.tag = tag;
        break;
    }
    return sight;
}

}  // namespace

MarkerDetector::MarkerDetector(std::string name, FindLens find_lens, bool wait)
    : Component(std::move(name), "MarkerDetector"),
      find_lens_(std::move(find_lens)),
      wait_(wait),
      image_(add_in_port<CameraImage>("image", "a camera's picture")),
      pos_(add_out_port<Pose3D>("pos",
                                "where the marker is from the camera: x forward, y left, z up; silent while none "
                                "is in sight")),
      visible_(add_out_port<bool>("visible", "whether a marker was in sight, once for each picture")),
      id_(add_out_port<std::int32_t>("id", "the marker's number, together with pos")) {
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
             .doc = "focal length along a row, of a calibrated camera; 0: that of the connected Camera"});
    declare({.name = "fy", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: as fx"});
    declare({.name = "cx", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: the middle"});
    declare({.name = "cy", .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = "with fx; 0: the middle"});
    declare({.name = "field_of_view",
             .initial = usual_field_of_view,
             .min = 0.05,
             .max = 2.8,
             .unit = "rad",
             .doc = "of a row, for pictures from elsewhere than a Camera while fx is 0"});
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

Intrinsics MarkerDetector::lens_for(const CameraImage& image) const {
    Intrinsics lens = Intrinsics::of(image.width, image.height, value<double>(parameters_, "field_of_view"));
    const double fx = value<double>(parameters_, "fx");
    if (fx > 0) {
        const auto given = [&](std::string_view name, double otherwise) {
            const double set = value<double>(parameters_, name);
            return set > 0 ? set : otherwise;
        };
        return {fx, given("fy", fx), given("cx", lens.cx), given("cy", lens.cy)};
    }
    return find_lens_ ? find_lens_().value_or(lens) : lens;
}

void MarkerDetector::start() {
    const auto& family = value<std::string>(parameters_, "family");
    if (!finder_ || family != family_) {
        finder_.emplace(family);
        family_ = family;
    }
    const CameraImage& image = image_.read();
    const Search search{value<std::int64_t>(parameters_, "id"), value<double>(parameters_, "tag_size"),
                        value<double>(parameters_, "yaw_from")};
    sight_.start(
        now(), value<double>(parameters_, "latency"),
        [finder = &*finder_, image, lens = lens_for(image), search] { return look(*finder, image, lens, search); });
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
    auto detector = std::make_unique<MarkerDetector>(
        entry.name,
        [&system, name = entry.name]() -> std::optional<Intrinsics> {
            for (const Connection& connection : system.connections()) {
                if (connection.to_component->name() != name) continue;
                if (const auto* camera = dynamic_cast<const Camera*>(connection.from_component))
                    return camera->intrinsics();
            }
            return std::nullopt;
        },
        true);
    return detector;
}

}  // namespace nezumi

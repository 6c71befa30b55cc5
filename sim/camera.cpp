// The camera of the simulation: an exposure copies the scene; developing paints it, distorts, blurs and adds noise.
#include "sim/camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "engine/ports/payload.hpp"
#include "sim/ode_world.hpp"

namespace nezumi::sim {
namespace {

constexpr Rgb robot_color = 0x4c5a6b;
constexpr Rgb led_color = 0xff2a20;
constexpr double led_edge = 0.008;  // [m] of a lit LED, a cube

// The lit LEDs: cubes in a row across the top of the hull, the first on the left.
void list_leds(const Shape& hull, const std::vector<bool>& on, std::vector<Solid>& solids) {
    const double pitch = 2 * hull.half.y() / static_cast<double>(on.size());
    const double half = std::min(led_edge, pitch * 0.75) / 2;
    for (std::size_t i = 0; i < on.size(); ++i) {
        if (!on[i]) continue;
        const Vec3 at{0, hull.half.y() - pitch * (static_cast<double>(i) + 0.5), hull.half.z() + half};
        solids.push_back(
            {{Shape::Kind::box, hull.centre + rotate(hull.rotation, at), hull.rotation, {half, half, half}},
             led_color});
    }
}

}  // namespace

SimCamera::SimCamera(const OdeWorld& world, std::optional<RobotId> carrier, const CameraMount& mount,
                     const CameraSettings& settings, std::shared_ptr<const Distortion> distortion)
    : world_(world),
      carrier_(carrier),
      on_carrier_{to_vec(mount.at), yaw_pitch_rotation(mount.yaw, mount.pitch)},
      settings_(settings),
      intrinsics_(settings.intrinsics()),
      distortion_(std::move(distortion)),
      noise_(settings.noise, settings.seed) {
    // A camera uses one core, because behaviours need the others. The picture does not depend on the number of threads.
    cv::setNumThreads(1);
}

std::optional<double> SimCamera::expose(const Time& now) {
    tick_ = now.tick;
    view_ = on_carrier_;
    if (carrier_) {
        const View robot = world_.frame_of(*carrier_);
        view_ = {robot.at + robot.rotation * on_carrier_.at, robot.rotation * on_carrier_.rotation};
    }
    scenery_ = {};
    world_.list_solids(carrier_, robot_color, scenery_.solids);
    scenery_.floor = world_.floor_picture();
    scenery_.floor_size = world_.floor_size();
    for (const MarkerPose& marker : world_.markers()) {
        const auto known = tags_.find(marker.id);
        const Picture& tag =
            known != tags_.end() ? known->second : tags_.emplace(marker.id, paint_tag(marker.id)).first->second;
        scenery_.signs.push_back({&tag, marker.size * tag_cells / tag_border_cells, to_vec(marker.pose.position),
                                  rotation_of(marker.pose.orientation)});
    }
    return now.seconds;
}

void SimCamera::develop(CameraImage& image) {
    image.width = static_cast<std::uint16_t>(settings_.width);
    image.height = static_cast<std::uint16_t>(settings_.height);
    image.bpp = settings_.color ? 24 : 8;
    image.format = settings_.color ? "rgb8" : "gray8";
    image.fDiv = 1;
    const int channels = settings_.color ? 3 : 1;
    const CameraIntrinsics& through = distortion_ ? distortion_->pinhole() : intrinsics_;
    paint(faces_of(scenery_, view_), sky, through, settings_.color, distortion_ ? undistorted_ : image.pixels);
    if (distortion_) distortion_->apply(undistorted_, channels, image.pixels);
    blur_picture(image.pixels, settings_.width, settings_.height, channels, settings_.blur);
    noise_.add_to(image.pixels, static_cast<std::size_t>(settings_.width) * channels,
                  static_cast<std::uint64_t>(tick_));
}

Expected<std::unique_ptr<CameraSource>> OdeWorld::open_camera(const CameraMount& mount,
                                                              const CameraSettings& settings) {
    std::optional<RobotId> carrier;
    for (RobotId i = 0; i < movers_.robots.size(); ++i) {
        if (!movers_.robots[i].gone && movers_.robots[i].name == mount.robot) carrier = i;
    }
    if (!mount.robot.empty() && !carrier)
        return failure(fmt::format("there is no robot '{}' that could carry a camera", shown(mount.robot)));
    const CameraIntrinsics wanted = settings.intrinsics();
    const bool distorts = std::array{wanted.k1, wanted.k2, wanted.p1, wanted.p2,
                                     wanted.k3, wanted.k4, wanted.k5, wanted.k6} != std::array<double, 8>{};
    if (distorts && (last_distortion_ == nullptr || last_distortion_->intrinsics() != wanted)) {
        auto made = Distortion::make(wanted);
        if (!made) return Unexpected(made.error());
        last_distortion_ = std::make_shared<const Distortion>(std::move(*made));
    }
    return std::make_unique<SimCamera>(*this, carrier, mount, settings, distorts ? last_distortion_ : nullptr);
}

View OdeWorld::frame_of(RobotId id) const {
    const SimRobot& robot = movers_.robots[id];
    const Rotation rotation = robot.body.rotation();
    return {robot.body.centre() + rotate(rotation, robot.model->origin), rotation};
}

void OdeWorld::list_solids(std::optional<RobotId> except, Rgb robots, std::vector<Solid>& solids) const {
    for (std::size_t i = 0; i < fixed_labels_.size(); ++i)
        solids.push_back({scene_.fixed()[i], parse_color(fixed_labels_[i].color)});
    for (std::size_t i = 0; i < movers_.things.size(); ++i)
        solids.push_back({scene_.movers()[i], parse_color(thing_labels_[i].color)});
    for (RobotId i = 0; i < movers_.robots.size(); ++i) {
        if (i == except || movers_.robots[i].gone) continue;
        const Shape& hull = scene_.movers()[movers_.robots[i].mover];
        solids.push_back({hull, robots});
        list_leds(hull, signals_[i].now.leds, solids);
    }
}

}  // namespace nezumi::sim

// Builds the system of a system file, reduced to one camera.
#include "hw/calibrate/guided_camera.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/devices/camera.hpp"
#include "engine/world/chessboard.hpp"

namespace nezumi::hw {
namespace {

constexpr double picture_patience = 30;  // [s] to wait for a picture

}  // namespace

Expected<std::unique_ptr<GuidedCamera>> GuidedCamera::make(SystemSpec spec, const std::string& name,
                                                           const Makers& makers, Options options) {
    std::unique_ptr<GuidedCamera> camera(new GuidedCamera(std::move(spec), std::move(options)));
    camera->entry_ = *find_entry<ComponentEntry>(camera->spec_, name);
    const RobotEntry* robot = find_entry<RobotEntry>(camera->spec_, camera->entry_.on);
    if (robot == nullptr)
        return failure(fmt::format("camera '{}' is not on a robot, so it has no calibration file: add on = "
                                   "\"NAME\"",
                                   name),
                       camera->entry_.place);
    camera->robot_ = *robot;
    if (auto built = camera->build(makers); !built) return Unexpected(built.error());
    return camera;
}

Expected<void> GuidedCamera::build(const Makers& makers) {
    // Without a robot: otherwise the calibration of that robot would be used.
    entry_.on.clear();
    entry_.active = true;
    entry_.config["undistort"] = false;
    entry_.backend = options_.simulated ? "" : makers.components.at("Camera").begin()->first;
    if (options_.simulated) {
        spec_.arena = {};
        spec_.arena.boxes = chessboard({});
    }
    spec_.connections.clear();
    spec_.entries = {entry_};
    auto system = build_system(spec_, makers, {.real_time = !options_.simulated, .log = options_.log});
    if (!system) return Unexpected(system.error());
    system_ = std::move(*system);
    Component& camera = *system_->find(entry_.name);
    if (auto active = camera.activate(system_->now()); !active) return active;
    out_ = static_cast<const OutPort<CameraImage>*>(std::as_const(camera).find_out_port("out"));
    pacer_ = std::make_unique<Pacer>(spec_.rate, 1);
    return {};
}

Expected<TimedPicture> GuidedCamera::next() {
    if (options_.simulated) return rehearse();
    const double since = system_->now().seconds;
    do {
        if (options_.end != nullptr && *options_.end != 0) return failure("interrupted: nothing was written");
        if (system_->now().seconds - since > picture_patience)
            return failure(fmt::format("no picture came for {} s", picture_patience));
        pacer_->wait();
        system_->tick();
    } while (out_->count() == count_);
    count_ = out_->count();
    return TimedPicture{out_->read(), system_->now().seconds};
}

// Gives each view twice, as if a person held the board still.
Expected<TimedPicture> GuidedCamera::rehearse() {
    const auto& camera = dynamic_cast<const Camera&>(*system_->find(entry_.name));
    auto source =
        system_->world()->open_camera(view_of_chessboard({}, static_cast<int>(count_++ / 2)), camera.settings());
    if (!source) return Unexpected(source.error());
    TimedPicture picture;
    (*source)->expose(system_->now());
    (*source)->develop(picture.image);
    return picture;
}

}  // namespace nezumi::hw

// The system of the file, of which only the camera is left.
#include "bindings/cli/guided/guided_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bindings/cli/base/environment.hpp"
#include "bindings/console/put_text.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "engine/base/visible.hpp"
#include "engine/devices/camera.hpp"
#include "engine/system/build_system.hpp"
#include "engine/world/chessboard.hpp"
#include "hw/drivers.hpp"

namespace nezumi::cli {
namespace {

constexpr double picture_patience = 30;  // [s] for a picture

template <class AnEntry>
const AnEntry* find_entry(const SystemSpec& spec, const std::string& name) {
    for (const Entry& entry : spec.entries) {
        const auto* found = std::get_if<AnEntry>(&entry);
        if (found != nullptr && found->name == name) return found;
    }
    return nullptr;
}

void say(const LogLine& line) { put_text(stderr, visible(fmt::format("{}: {}", line.component, line.text)) + "\n"); }

}  // namespace

Expected<std::unique_ptr<GuidedCamera>> GuidedCamera::make(const CameraSetup& setup,
                                                           const volatile std::sig_atomic_t& end) {
    std::unique_ptr<GuidedCamera> camera(new GuidedCamera(setup, end));
    if (auto chosen = camera->choose(setup); !chosen) return Unexpected(chosen.error());
    if (auto built = camera->build(setup.hardware); !built) return Unexpected(built.error());
    return camera;
}

Expected<void> GuidedCamera::choose(const CameraSetup& setup) {
    auto spec = read_system_file(setup.file, Project::of(setup.file, installed_folders()));
    if (!spec) return Unexpected(spec.error());
    spec_ = std::move(*spec);
    std::vector<std::string_view> names;
    for (const Entry& entry : spec_.entries) {
        const auto* component = std::get_if<ComponentEntry>(&entry);
        if (component != nullptr && component->type == "Camera") names.push_back(component->name);
    }
    const auto name = the_one(names, setup.camera, "camera", spec_.file);
    if (!name) return Unexpected(name.error());
    entry_ = *find_entry<ComponentEntry>(spec_, *name);
    const RobotEntry* robot = find_entry<RobotEntry>(spec_, entry_.on);
    if (robot == nullptr)
        return failure(fmt::format("camera '{}' is on no robot, whose calibration would have it: give it one by on = "
                                   "\"NAME\"",
                                   *name),
                       entry_.place);
    robot_ = *robot;
    return {};
}

Expected<void> GuidedCamera::build(const Hardware& hardware) {
    Makers makers;
    // By itself: what was measured of it before would be a robot's.
    entry_.on.clear();
    entry_.active = true;
    entry_.config["undistort"] = false;
    if (is_simulated_) {
        const LiveOptions simulated = simulated_systems();
        makers.world = simulated.world;
        makers.components = simulated.components;
        entry_.backend.clear();
        spec_.arena = {};
        spec_.arena.boxes = chessboard({});
    } else {
        makers.components = hw::device_drivers({.dev = hardware.dev_root, .sys = hardware.sys_root});
        entry_.backend = makers.components.at("Camera").begin()->first;
    }
    spec_.connections.clear();
    spec_.entries = {entry_};
    auto system = build_system(spec_, makers, {.real_time = !is_simulated_, .log = say});
    if (!system) return Unexpected(system.error());
    system_ = std::move(*system);
    Component& camera = *system_->find(entry_.name);
    if (auto active = camera.activate(system_->now()); !active) return active;
    out_ = static_cast<const OutPort<CameraImage>*>(std::as_const(camera).find_out_port("out"));
    pacer_ = std::make_unique<Pacer>(spec_.rate, 1);
    return {};
}

Expected<hw::TimedPicture> GuidedCamera::next() {
    if (is_simulated_) return rehearse();
    const double since = system_->now().seconds;
    do {
        if (end_ != 0) return failure("ended before it was done: nothing was written");
        if (system_->now().seconds - since > picture_patience)
            return failure(fmt::format("no picture came for {} s", picture_patience));
        pacer_->wait();
        system_->tick();
    } while (out_->count() == count_);
    count_ = out_->count();
    return hw::TimedPicture{out_->read(), system_->now().seconds};
}

// Each view twice, as of a board that is held still.
Expected<hw::TimedPicture> GuidedCamera::rehearse() {
    const auto& camera = dynamic_cast<const Camera&>(*system_->find(entry_.name));
    auto source =
        system_->world()->open_camera(view_of_chessboard({}, static_cast<int>(count_++ / 2)), camera.settings());
    if (!source) return Unexpected(source.error());
    hw::TimedPicture picture;
    (*source)->expose(system_->now());
    (*source)->develop(picture.image);
    return picture;
}

}  // namespace nezumi::cli

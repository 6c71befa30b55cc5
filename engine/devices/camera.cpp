// Takes an exposure at the frame rate, and computes the picture in another thread.
#include "engine/devices/camera.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

#include "engine/base/schedule.hpp"
#include "engine/system/system.hpp"

namespace nezumi {
namespace {

constexpr double usual_field_of_view = 1.0472;  // [rad] 60 degrees, a common webcam

std::uint64_t seed_of(std::uint64_t run_seed, const std::string& name) { return mix(run_seed, name); }

template <class T>
const T& value(const Parameters& parameters, std::string_view name) {
    return parameters.find(name)->value.get<T>();
}

}  // namespace

Camera::Camera(std::string name, CameraMount mount, std::uint64_t seed, Open open, bool wait)
    : Device(std::move(name), "Camera"),
      mount_(std::move(mount)),
      seed_(seed),
      open_(std::move(open)),
      wait_(wait),
      out_(add_out_port<CameraImage>("out", "the picture")),
      intrinsics_(
          add_out_port<CameraIntrinsics>("intrinsics", "intrinsics of the picture that is published with them")) {
    out_.set_companion(intrinsics_);
    const auto declare = [this](ParameterSpec spec) {
        const auto ok = parameters_.declare(std::move(spec));
        assert(ok);
        static_cast<void>(ok);
    };
    using Integer = std::int64_t;
    declare({.name = "device", .initial = std::string(), .doc = "a real camera's device; empty: the first one found"});
    declare(
        {.name = "pixel_format",
         .initial = std::string(),
         .doc =
             "pixel format of a real camera, four letters as v4l2-ctl --list-formats shows them: \"MJPG\", \"YUYV\"; "
             "empty: the camera's choice"});
    declare({.name = "width", .initial = Integer{640}, .min = least_picture, .max = largest_picture, .unit = "px"});
    declare({.name = "height", .initial = Integer{480}, .min = least_picture, .max = largest_picture, .unit = "px"});
    declare(
        {.name = "frame_rate", .initial = 30.0, .min = 0.01, .max = 1000, .unit = "Hz", .doc = "pictures per second"});
    declare({.name = "format",
             .initial = std::string("rgb8"),
             .doc = "how a pixel is stored",
             .choices = {std::string("rgb8"), std::string("gray8")}});
    declare({.name = "field_of_view",
             .initial = usual_field_of_view,
             .min = 0.05,
             .max = 2.8,
             .unit = "rad",
             .doc = "angle between the picture's left and right edge"});
    for (const auto& [name_of_it, doc] :
         {std::pair{"fx", "focal length in x, from a calibration; 0: computed from field_of_view"},
          {"fy", "with fx: focal length in y; 0: same as fx"},
          {"cx", "with fx: principal point in x; 0: the middle"},
          {"cy", "with fx: principal point in y; 0: the middle"}}) {
        declare({.name = name_of_it, .initial = 0.0, .min = 0, .max = 1e6, .unit = "px", .doc = doc});
    }
    for (const char* radial : {"k1", "k2", "k3", "k4", "k5", "k6"}) {
        declare({.name = radial, .initial = 0.0, .min = -20, .max = 20, .doc = "radial distortion of the lens"});
    }
    for (const char* tangential : {"p1", "p2"}) {
        declare(
            {.name = tangential, .initial = 0.0, .min = -0.2, .max = 0.2, .doc = "tangential distortion of the lens"});
    }
    declare({.name = "undistort",
             .initial = false,
             .doc = "remove the distortion: the pictures are those of a pinhole camera"});
    declare({.name = "pitch", .initial = 0.0, .min = -1.58, .max = 1.58, .unit = "rad", .doc = "positive looks down"});
    declare({.name = "noise",
             .initial = 0.0,
             .min = 0,
             .max = 100,
             .doc = "standard deviation of a pixel's value, which goes from 0 to 255"});
    declare({.name = "blur",
             .initial = 0.0,
             .min = 0,
             .max = 10,
             .unit = "px",
             .doc = "standard deviation of the blur; 0: sharp"});
    declare({.name = "latency",
             .initial = 0.02,
             .min = 0,
             .max = 10,
             .unit = "s",
             .doc = "from exposure to publication, in simulated time"});
}

CameraSettings Camera::settings() const {
    const auto frame_rate = value<double>(parameters_, "frame_rate");
    return {.device = value<std::string>(parameters_, "device"),
            .width = static_cast<int>(value<std::int64_t>(parameters_, "width")),
            .height = static_cast<int>(value<std::int64_t>(parameters_, "height")),
            .frame_rate = rate > 0 ? std::min(rate, frame_rate) : frame_rate,
            .field_of_view = value<double>(parameters_, "field_of_view"),
            .k1 = value<double>(parameters_, "k1"),
            .k2 = value<double>(parameters_, "k2"),
            .p1 = value<double>(parameters_, "p1"),
            .p2 = value<double>(parameters_, "p2"),
            .k3 = value<double>(parameters_, "k3"),
            .k4 = value<double>(parameters_, "k4"),
            .k5 = value<double>(parameters_, "k5"),
            .k6 = value<double>(parameters_, "k6"),
            .color = value<std::string>(parameters_, "format") == "rgb8",
            .noise = value<double>(parameters_, "noise"),
            .blur = value<double>(parameters_, "blur"),
            .seed = seed_of(seed_, name()),
            .fx = value<double>(parameters_, "fx"),
            .fy = value<double>(parameters_, "fy"),
            .cx = value<double>(parameters_, "cx"),
            .cy = value<double>(parameters_, "cy"),
            .undistort = value<bool>(parameters_, "undistort"),
            .pixel_format = value<std::string>(parameters_, "pixel_format")};
}

Expected<void> Camera::check_frame_rate() const {
    const double wanted = settings().frame_rate;
    if (wanted <= tick_rate()) return {};
    return failure(fmt::format("frame_rate {} Hz is above the tick's {} Hz", wanted, tick_rate()), place);
}

Expected<std::unique_ptr<CameraSource>> Camera::make_source() const {
    CameraMount mount = mount_;
    mount.pitch = value<double>(parameters_, "pitch");
    return open_(mount, settings());
}

Expected<void> Camera::check() const {
    if (auto ok = check_frame_rate(); !ok || !wait_) return ok;
    const auto source = make_source();
    return source ? Expected<void>() : Unexpected(source.error());
}

Expected<void> Camera::open() {
    picture_.finish();
    if (auto ok = check_frame_rate(); !ok) return ok;
    source_.reset();  // closes the device: it can be open only once
    auto source = make_source();
    if (!source) return Unexpected(source.error());
    source_ = std::move(*source);
    parameters_version_ = parameters_.version();
    frame_rate_ = settings().frame_rate;
    out_.set_rate(frame_rate_);
    latency_ = value<double>(parameters_, "latency");
    return {};
}

Expected<void> Camera::on_activated() { return open(); }

Expected<void> Camera::on_deactivated() {
    picture_.finish();
    source_.reset();
    return {};
}

void Camera::sense(const Time& now) {
    if (state() != LifeState::active) return;
    set_now(now);
    parameters_.take_staged();
    if (parameters_.version() != parameters_version_) {
        if (auto ok = open(); !ok) {
            abort(ok.error());
            return;
        }
    }
    for (std::string& fault : source_->take_faults()) log(LogLevel::warn, std::move(fault));
    if (source_->is_device()) {
        look_at_device(now);
        return;
    }
    take_picture(now);
    if (state() != LifeState::active || picture_.busy()) return;
    if (!is_due(now.tick, frame_rate_, tick_rate(), now.left_out)) return;
    exposed_at_ = source_->expose(now).value_or(now.seconds);
    picture_.start(now, latency_, [source = source_.get()] {
        CameraImage image;
        source->develop(image);
        return image;
    });
    take_picture(now);
}

void Camera::look_at_device(const Time& now) {
    const auto exposed_at = source_->expose(now);
    if (!exposed_at) return;
    exposed_at_ = *exposed_at;
    source_->develop(out_.next_pending());
    publish_intrinsics();
}

void Camera::take_picture(const Time& now) {
    auto picture = picture_.take(now, wait_);
    if (!picture) return;
    if (!*picture) {
        abort({"no picture could be made: " + picture->error().message});
        return;
    }
    out_.next_pending() = std::move(**picture);
    publish_intrinsics();
}

void Camera::publish_intrinsics() {
    intrinsics_.write(source_->intrinsics());
    out_.stamp(exposed_at_);
    intrinsics_.stamp(exposed_at_);
}

Expected<std::unique_ptr<Component>> make_camera(const ComponentEntry& entry, System& system, Camera::Open open) {
    if (!entry.on.empty() && system.find_robot(entry.on) == nullptr) {
        return failure(fmt::format("component '{}': on: there is no robot '{}' before it{}", entry.name, entry.on,
                                   did_you_mean(entry.on, system.robots(), &Robot::name)),
                       entry.place);
    }
    auto camera = std::make_unique<Camera>(entry.name, CameraMount{.robot = entry.on, .at = entry.at, .yaw = entry.yaw},
                                           system.settings().seed, std::move(open), !system.settings().real_time);
    camera->set_tick_rate(system.settings().rate);
    camera->rate = entry.rate;
    // Invalid parameter values are reported with their location later, when they are set.
    if (camera->parameters().set_all(entry.config)) {
        if (auto ok = camera->check(); !ok)
            return failure(fmt::format("component '{}': {}", entry.name, ok.error().message), entry.place);
    }
    return camera;
}

Expected<std::unique_ptr<Component>> make_simulated_camera(const ComponentEntry& entry, System& system) {
    if (system.world() == nullptr)
        return failure(fmt::format("component '{}': a Camera needs a world to look at", entry.name), entry.place);
    return make_camera(entry, system,
                       [world = system.world()](const CameraMount& mount, const CameraSettings& settings) {
                           return world->open_camera(mount, settings);
                       });
}

}  // namespace nezumi

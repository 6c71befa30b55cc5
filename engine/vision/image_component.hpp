// The common base of components that analyse pictures: one detection at a time, in another thread.
#pragma once

#include <fmt/format.h>

#include <cassert>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "engine/components/component.hpp"
#include "engine/components/delayed_task.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Analyses pictures of its in-port `image`. While one is analysed, only the newest of the next pictures is kept.
/// `Seen` is the result for a picture; `Seen{}`: nothing.
template <class Seen>
class ImageComponent : public Component {
protected:
    /// A detection in one picture: called once, in a separate thread, while the component exists. Members of the
    /// component that the task uses must outlive the task, so the component's destructor calls `finish`.
    using DetectionTask = std::function<Seen()>;

    /// `wait`: the result for the picture of time t is published at exactly t + latency (simulation), otherwise as soon
    /// as it is known (hardware).
    ImageComponent(std::string name, std::string type, bool wait)
        : Component(std::move(name), std::move(type)),
          wait_(wait),
          image_(add_in_port<CameraImage>("image", "a camera's picture")) {}

    /// Prepares the detection in this picture. The error says why nothing can be detected; it is logged once. The
    /// picture belongs to the port, and may change while the task runs. So the task uses a copy in memory of the
    /// component, which takes 0.03 ms of a tick at 640 x 480 in colour, and does the rest (smoothing alone takes twenty
    /// times as long) in another thread.
    virtual Expected<DetectionTask> detection_task(const CameraImage& image) = 0;
    /// Writes a result, which gets the time stamp of its picture.
    virtual void publish(const Seen& seen) = 0;

    /// Declares a parameter, in the component's constructor.
    void declare(ParameterSpec spec) {
        const auto ok = parameters_.declare(std::move(spec));
        assert(ok);
        static_cast<void>(ok);
    }
    void declare_latency() {
        declare({.name = "latency",
                 .initial = 0.02,
                 .min = 0,
                 .max = 10,
                 .unit = "s",
                 .doc = "from a picture to its result, in simulated time"});
    }
    template <class T>
    const T& value(std::string_view parameter) const {
        return parameters_.find(parameter)->value.template get<T>();
    }
    InPortBase& image_port() { return image_; }
    /// Waits for the running detection, if there is one, and drops its result.
    void finish() { detection_.finish(); }

private:
    Expected<void> on_activated() override {
        finish();
        fault_.clear();
        told_ = false;
        return {};
    }

    Expected<void> on_deactivated() override {
        finish();
        return {};
    }

    Expected<void> on_execute() override {
        if (auto ok = take(); !ok) return ok;
        if (detection_.busy() || !image_.is_new()) return {};
        start();
        return take();
    }

    void start() {
        auto task = detection_task(image_.read());
        exposed_at_ = image_.tm();
        fault_ = task ? std::string() : task.error().message;
        detection_.start(now(), value<double>("latency"),
                         task ? std::move(*task) : DetectionTask([] { return Seen{}; }));
    }

    Expected<void> take() {
        const auto seen = detection_.take(now(), wait_);
        if (!seen) return {};
        if (!*seen) return failure("the picture could not be searched: " + seen->error().message);
        if (!fault_.empty() && !told_) log(LogLevel::warn, fault_ + ": the picture is not searched");
        told_ = !fault_.empty();
        publish(**seen);
        // The result is as old as the picture.
        for (const auto& port : out_ports()) {
            if (port->pending() > 0) port->stamp(exposed_at_);
        }
        return {};
    }

    bool wait_;
    InPort<CameraImage>& image_;
    double exposed_at_ = 0;  // [s] time stamp of the picture that is analysed
    std::string fault_;      // why nothing can be detected in the picture that is analysed
    bool told_ = false;
    DelayedTask<Seen> detection_;
};

/// Makes the component `entry`, a `T`, for `Makers::components` in a simulation. An error if `entry` has an `on`.
template <class T>
Expected<std::unique_ptr<Component>> make_image_component(const ComponentEntry& entry, System& system) {
    if (!entry.on.empty()) {
        return failure(fmt::format("component '{}': a {} is not mounted on a robot: 'on' is for its Camera", entry.name,
                                   entry.type),
                       entry.place);
    }
    return std::make_unique<T>(entry.name, !system.settings().real_time);
}

}  // namespace nezumi

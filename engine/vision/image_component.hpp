// What components that look at pictures have in common: a picture in, work beside the tick, one detection at a time.
#pragma once

#include <fmt/format.h>

#include <cassert>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "engine/components/component.hpp"
#include "engine/components/delayed_task.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

/// Looks at the pictures that come to its in-port `image`. Those that come while it looks are passed over but for the
/// newest. `Seen` is what a picture shows; `Seen{}`: nothing.
template <class Seen>
class ImageComponent : public Component {
protected:
    /// A picture and what is looked for in it: called once, on a thread of its own, while the component lives. Whatever
    /// of the component it uses must outlive it: then the component's destructor calls `finish`.
    using DetectionTask = std::function<Seen()>;

    /// `wait`: what was seen in the picture of t is published at t + latency exactly (simulation), else as soon as it
    /// is known (hardware).
    ImageComponent(std::string name, std::string type, bool wait)
        : Component(std::move(name), std::move(type)),
          wait_(wait),
          image_(add_in_port<CameraImage>("image", "a camera's picture")) {}

    /// What there is to do with this picture. An error says why nothing can be seen in it: it is told once in the log.
    /// The picture is the port's, and may change or go while the task runs. The task reads a copy in memory that the
    /// component keeps for it, 0.03 ms of a tick at 640 x 480 in colour, and does the rest (smoothing alone takes
    /// twenty times as long) beside the tick.
    virtual Expected<DetectionTask> detection_task(const CameraImage& image) = 0;
    /// Writes what was seen, which gets the stamp of its picture.
    virtual void publish(const Seen& seen) = 0;

    /// A parameter, as a part of the component's constructor.
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
                 .doc = "from a picture to what it shows, in simulated time"});
    }
    template <class T>
    const T& value(std::string_view parameter) const {
        return parameters_.find(parameter)->value.template get<T>();
    }
    InPortBase& image_port() { return image_; }
    /// Waits for the detection that is under way, if there is one, and forgets what it saw.
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
        if (!fault_.empty() && !told_) log(LogLevel::warn, fault_ + ": nothing can be seen in it");
        told_ = !fault_.empty();
        publish(**seen);
        // What is known of the world is as old as the picture.
        for (const auto& port : out_ports()) {
            if (port->pending() > 0) port->stamp(exposed_at_);
        }
        return {};
    }

    bool wait_;
    InPort<CameraImage>& image_;
    double exposed_at_ = 0;  // [s] stamp of the picture that is looked at
    std::string fault_;      // why nothing can be seen in the picture that is looked at
    bool told_ = false;
    DelayedTask<Seen> detection_;
};

/// Makes the component `entry`, a `T`; what `Makers::components` wants for its type in a simulation. An error when it
/// has an `on`.
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

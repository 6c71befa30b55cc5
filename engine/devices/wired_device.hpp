// A component that exchanges messages with a device on a wire: a serial line, a bus, a socket.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/component.hpp"
#include "engine/system/build_system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi {

class Robot;
class System;

/// A kind of device: its word in robot files, and its component.
struct DeviceKind {
    std::string_view word;  ///< "serial"
    std::string_view type;  ///< of the component: "Serial"
    std::vector<ParameterSpec> parameters;
    /// What is wrong with values that do not go together; "": nothing. Null: all do.
    std::string (*check)(const Parameters& parameters) = nullptr;
    bool is_text = false;  ///< messages are texts, also without the parameter `ends`
    /// What is wrong with a message to the device; "": nothing. Null: any bytes are right.
    std::string (*check_message)(const Parameters& parameters, std::string_view message) = nullptr;
};
/// All kinds.
std::span<const DeviceKind> device_kinds();
/// Null if there is no such type of component.
const DeviceKind* find_device_kind(std::string_view type);

/// The connection to a real device, which works in the background. No function waits.
class DeviceLink {
public:
    struct Message {
        double tm = 0;  ///< [s] of its arrival, by the system's time
        std::string bytes;
    };
    virtual ~DeviceLink() = default;
    /// What has arrived since the last call, oldest first.
    virtual std::vector<Message> take(const Time& now) = 0;
    /// Sends a message, with its end, after the earlier ones.
    virtual void send(std::string_view bytes) = 0;
    /// The control loop is alive, and what is sent may move something. Without this call for 0.2 s, the safe bytes are
    /// sent.
    virtual void beat() = 0;
    /// Drops what has not been sent, completes a message that is being sent, and sends the safe bytes. No beats are
    /// needed until the next `beat`.
    virtual void stop() = 0;
    /// Whether it can send, and what it sends can be stopped.
    virtual bool works() const = 0;
    /// The faults since the last call: one line each, with what to do.
    virtual std::vector<std::string> take_faults() = 0;
};

/// Its out-port `out` publishes what the device sends; what arrives at `in` is sent to the device. Both are
/// TimedString, if its kind has texts, or, one message for each line, if the parameter `ends` is given; else
/// TimedOctetSeq. In simulation `wire_out` has what would be sent, and what arrives at `wire_in` counts as sent by the
/// device: for a behaviour that stands for it.
///
/// It sends only while it is open: it is ACTIVE, so are all components that write to `in`, nothing is stopped or
/// paused, and the motors of the robot that it is on have power. When it closes, and when a component that writes to
/// `in` changes its version, it sends its `safe` bytes. A device without `safe` is always open while it is ACTIVE.
class WiredDevice final : public Device {
public:
    /// `link`: null in simulation. The system, and the robot that it is on, must outlive it.
    WiredDevice(std::string name, const DeviceKind& kind, const ParameterValues& config, System& system,
                const Robot* robot, std::unique_ptr<DeviceLink> link);

    void sense(const Time& now) override;
    void actuate(const Time& now) override;

    /// Whether what is sent reaches the device. A device that only measures always works.
    bool works() const { return link_ == nullptr || measures_only_ || link_->works(); }

    /// Messages that wait; more than these are dropped, the oldest first.
    static constexpr std::size_t queue = 1000;

private:
    bool may_send() const;
    std::uint64_t versions_of_senders() const;
    void publish(std::string_view bytes, std::optional<double> tm);
    void send(std::string_view bytes);
    void stop();

    const DeviceKind& kind_;
    const System& system_;
    const Robot* robot_;
    std::unique_ptr<DeviceLink> link_;
    std::string ends_, safe_;
    bool measures_only_;
    InPortBase* in_ = nullptr;
    OutPortBase* out_ = nullptr;
    InPortBase* wire_in_ = nullptr;    // unused by a real device
    OutPortBase* wire_out_ = nullptr;  // the same
    bool was_open_ = false;
    bool said_wrong_ = false;  // that the messages to the device are wrong
    std::uint64_t versions_ = 0;
};

/// The checked parameters of the component `entry`, of a type of `device_kinds()`.
Expected<Parameters> device_parameters(const ComponentEntry& entry);

/// Opens the real device of a component by its parameters, which have been checked.
using OpenDevice = std::function<Expected<std::unique_ptr<DeviceLink>>(const Parameters& parameters)>;

/// Makes the component `entry`, of a type of `device_kinds()`. Without `open` it is simulated. An error if a parameter
/// is wrong; and with `open`, if it neither has `safe` nor only measures, or if the device can't be opened.
Expected<std::unique_ptr<Component>> make_wired_device(const ComponentEntry& entry, System& system,
                                                       const OpenDevice& open = {});
/// Adds the factories of simulated devices of all kinds.
void add_simulated_devices(decltype(Makers::components)& makers);

}  // namespace nezumi

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

/// A kind of device: the name of its function in robot files, and its type of component.
struct DeviceKind {
    std::string_view word;  ///< "serial"
    std::string_view type;  ///< of the component: "Serial"
    std::vector<ParameterSpec> parameters;
    /// Returns the error for parameter values that do not go together, or "". Null: there is no such rule.
    std::string (*check)(const Parameters& parameters) = nullptr;
    bool is_text = false;  ///< messages are texts, also without the parameter `ends`
    /// Returns the error for a message to the device, or "". Null: any bytes are accepted.
    std::string (*check_message)(const Parameters& parameters, std::string_view message) = nullptr;
};
/// All kinds.
std::span<const DeviceKind> device_kinds();
/// The kind with this type of component, or null.
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
    /// Shows that the control loop is alive; called in every tick in which messages may move something. If there is no
    /// call for 0.2 s, the safe bytes are sent.
    virtual void beat() = 0;
    /// Drops what has not been sent, completes a message that is being sent, and sends the safe bytes. The
    /// limit of 0.2 s counts again from the next `beat` on.
    virtual void stop() = 0;
    /// Whether messages can be sent to the device, and the safe bytes too.
    virtual bool works() const = 0;
    /// The faults since the last call: one line each, with what to do.
    virtual std::vector<std::string> take_faults() = 0;
};

/// The out-port `out` publishes what the device sends; messages to `in` are sent to the device. Both are TimedString if
/// the kind has text messages, or if the parameter `ends` is given (then a message is a line); else TimedOctetSeq. In
/// simulation a behaviour can replace the device: `wire_out` publishes what would be sent, and messages to `wire_in`
/// count as sent by the device.
///
/// Messages are sent only while the device is open: it and all components that write to `in` are ACTIVE, the system is
/// not paused, and the robot that carries the device has power for its motors (without a robot: the system is not
/// stopped). When it closes, or when a component that writes to `in` changes its version, the `safe` bytes are sent. A
/// device without `safe` is open whenever it is ACTIVE.
class WiredDevice final : public Device {
public:
    /// `link`: null in simulation. `system`, and the `robot` that carries the device (or null), must outlive it.
    WiredDevice(std::string name, const DeviceKind& kind, const ParameterValues& config, System& system,
                const Robot* robot, std::unique_ptr<DeviceLink> link);

    void sense(const Time& now) override;
    void actuate(const Time& now) override;

    /// Whether messages can reach the device. Always true in simulation, and for a device that only measures.
    bool works() const { return link_ == nullptr || measures_only_ || link_->works(); }

    /// The largest number of waiting messages; if there are more, the oldest are dropped.
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
    bool said_wrong_ = false;  // the last message to the device was wrong, which was reported
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

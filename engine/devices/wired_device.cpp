// Decides in every tick whether messages may reach the device.
#include "engine/devices/wired_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/robot/robot.hpp"
#include "engine/system/system.hpp"

namespace nezumi {
namespace {

bool is_text(const Port& port) { return port.type() == message_of<std::string>(); }

std::string take_bytes(InPortBase& port) {
    if (is_text(port)) return static_cast<InPort<std::string>&>(port).read();
    const Octets& octets = static_cast<InPort<Octets>&>(port).read();
    return {octets.begin(), octets.end()};
}

void write_bytes(OutPortBase& port, std::string_view bytes) {
    if (is_text(port)) {
        static_cast<OutPort<std::string>&>(port).write(std::string(bytes));
    } else {
        static_cast<OutPort<Octets>&>(port).write(Octets(bytes.begin(), bytes.end()));
    }
}

}  // namespace

WiredDevice::WiredDevice(std::string name, const DeviceKind& kind, const ParameterValues& config, System& system,
                         const Robot* robot, std::unique_ptr<DeviceLink> link)
    : Device(std::move(name), std::string(kind.type)),
      kind_(kind),
      system_(system),
      robot_(robot),
      link_(std::move(link)) {
    for (const ParameterSpec& parameter : kind.parameters) static_cast<void>(parameters_.declare(parameter));
    static_cast<void>(parameters_.set_all(config));
    const auto text = [this](std::string_view parameter) {
        const auto* found = parameters_.find(parameter);
        return found != nullptr ? found->value.get<std::string>() : std::string();
    };
    ends_ = text("ends");
    safe_ = text("safe");
    measures_only_ = parameters_.find("measures_only")->value.get<bool>();
    const MessageType* type = ends_.empty() && !kind.is_text ? message_of<Octets>() : message_of<std::string>();
    const auto add_in = [&](const char* port, const char* doc) {
        in_ports_.push_back(make_in_port(type, port, doc, queue));
        return in_ports_.back().get();
    };
    const auto add_out = [&](const char* port, const char* doc) {
        out_ports_.push_back(make_out_port(type, port, doc));
        return out_ports_.back().get();
    };
    in_ = add_in("in", "messages to the device");
    out_ = add_out("out", "messages from the device");
    wire_in_ = add_in("wire_in", "in simulation: messages that count as sent by the device");
    wire_out_ = add_out("wire_out", "in simulation: messages that reach the device");
}

void WiredDevice::publish(std::string_view bytes, std::optional<double> tm) {
    write_bytes(*out_, bytes);
    if (tm) out_->stamp(*tm);
}

void WiredDevice::sense(const Time& now) {
    if (link_ != nullptr) {
        for (std::string& fault : link_->take_faults()) log(LogLevel::warn, std::move(fault));
        for (const DeviceLink::Message& message : link_->take(now)) {
            if (state() == LifeState::active) publish(message.bytes, message.tm);
        }
        return;
    }
    while (wire_in_->is_new()) {
        const std::string bytes = take_bytes(*wire_in_);
        if (state() == LifeState::active) publish(bytes, std::nullopt);
    }
}

// The sum of the senders' versions. It changes if a sender is reloaded or rolled back, or if connections change.
std::uint64_t WiredDevice::versions_of_senders() const {
    std::uint64_t sum = 0;
    for (const Connection& each : system_.wiring().connections()) {
        if (each.to == in_) sum += static_cast<std::uint64_t>(each.from_component->version());
    }
    return sum;
}

bool WiredDevice::may_send() const {
    if (state() != LifeState::active) return false;
    if (safe_.empty()) return true;
    if (system_.is_at_rest()) return false;
    if (robot_ != nullptr ? !robot_->has_power() : system_.is_stopped()) return false;
    const auto& all = system_.wiring().connections();
    return std::all_of(all.begin(), all.end(), [this](const Connection& each) {
        return each.to != in_ || each.from_component->state() == LifeState::active;
    });
}

void WiredDevice::send(std::string_view bytes) {
    const std::string wrong = kind_.check_message != nullptr ? kind_.check_message(parameters_, bytes) : "";
    if (!wrong.empty() && !said_wrong_) log(LogLevel::warn, "a message was dropped: " + wrong);
    said_wrong_ = !wrong.empty();
    if (said_wrong_) return;
    if (link_ == nullptr) {
        write_bytes(*wire_out_, bytes);
    } else {
        link_->send(bytes);
    }
}

void WiredDevice::stop() {
    if (safe_.empty()) return;
    if (link_ != nullptr) return link_->stop();
    if (ends_.empty()) return write_bytes(*wire_out_, safe_);
    std::string_view rest = safe_;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(ends_), rest.size());
        write_bytes(*wire_out_, rest.substr(0, end));
        rest.remove_prefix(std::min(rest.size(), end + ends_.size()));
    }
}

void WiredDevice::actuate(const Time& /*now*/) {
    const std::uint64_t versions = versions_of_senders();
    const bool changed = std::exchange(versions_, versions) != versions;
    const bool open = may_send();
    if (std::exchange(was_open_, open) && (!open || changed)) stop();
    if (open && link_ != nullptr && !safe_.empty()) link_->beat();
    while (in_->is_new()) {
        const std::string bytes = take_bytes(*in_);
        if (open) send(bytes);
    }
}

Expected<Parameters> device_parameters(const ComponentEntry& entry) {
    const DeviceKind& kind = *find_device_kind(entry.type);
    const auto refuse = [&](const std::string& why) {
        return failure(fmt::format("component '{}': {}", entry.name, why), entry.place);
    };
    Parameters parameters;
    for (const ParameterSpec& parameter : kind.parameters) static_cast<void>(parameters.declare(parameter));
    if (auto ok = parameters.set_all(entry.config); !ok) return refuse(ok.error().message);
    if (kind.check != nullptr) {
        if (const std::string wrong = kind.check(parameters); !wrong.empty()) return refuse(wrong);
    }
    const auto& safe = parameters.find("safe")->value.get<std::string>();
    if (safe.size() > 255) return refuse(fmt::format("safe has {} bytes: expected at most 255", safe.size()));
    if (parameters.find("measures_only")->value.get<bool>() && !safe.empty())
        return refuse("a device that only measures needs no safe bytes: give either safe or measures_only");
    return parameters;
}

Expected<std::unique_ptr<Component>> make_wired_device(const ComponentEntry& entry, System& system,
                                                       const OpenDevice& open) {
    const auto refuse = [&](const std::string& why) {
        return failure(fmt::format("component '{}': {}", entry.name, why), entry.place);
    };
    const auto parameters = device_parameters(entry);
    if (!parameters) return Unexpected(parameters.error());
    auto* robot = entry.on.empty() ? nullptr : dynamic_cast<Robot*>(system.find(entry.on));
    std::unique_ptr<DeviceLink> link;
    if (open) {
        if (parameters->find("safe")->value.get<std::string>().empty() &&
            !parameters->find("measures_only")->value.get<bool>())
            return refuse(
                "--hw needs the device's safe bytes: give safe = \"...\", the bytes that stop it, or safe = false in a "
                "robot file (measures_only = true in a system) if it moves nothing");
        auto opened = open(*parameters);
        if (!opened) return refuse(opened.error().message);
        link = std::move(*opened);
    }
    const DeviceKind& kind = *find_device_kind(entry.type);
    auto made = std::make_unique<WiredDevice>(entry.name, kind, entry.config, system, robot, std::move(link));
    ScriptedBody* body = robot != nullptr ? robot->scripted_body() : nullptr;
    if (body != nullptr) body->need(*made, [device = made.get()] { return device->works(); });
    return made;
}

void add_simulated_devices(decltype(Makers::components)& makers) {
    for (const DeviceKind& kind : device_kinds()) {
        makers[std::string(kind.type)]["sim"] = [](const ComponentEntry& entry, System& system) {
            return make_wired_device(entry, system);
        };
    }
}

}  // namespace nezumi

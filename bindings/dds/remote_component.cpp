// A port is made when a connection first needs it, and is never removed.
#include "bindings/dds/remote_component.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/system/wiring.hpp"

namespace nezumi::dds {

RemoteComponent::RemoteComponent(std::string_view host, std::string_view component, std::function<double()> clock)
    : Device(fmt::format("{}/{}", host, component), "RemoteComponent"), host_(host), clock_(std::move(clock)) {}

Port& RemoteComponent::port(const std::string& name, const MessageType* type, Direction direction) {
    if (Port* found = find_port(name)) return *found;
    const std::string doc = fmt::format("of host {}", host_);
    if (direction == Direction::in) return *in_ports_.emplace_back(make_in_port(type, name, doc, 0));
    return *out_ports_.emplace_back(make_out_port(type, name, doc));
}

void RemoteComponent::receive(OutPortBase& port, std::unique_ptr<Reader> reader) {
    inlets_.erase(&port);
    if (reader != nullptr) inlets_.try_emplace(&port, port.type(), std::move(reader), progress_[&port]);
}

const Counts* RemoteComponent::counts(const OutPortBase& port) const {
    const auto found = inlets_.find(&port);
    return found != inlets_.end() ? &found->second.counts() : nullptr;
}

void RemoteComponent::receive(const MessageDoor& deliver) {
    const double clock = clock_();
    for (const auto& port : out_ports_) {
        const auto inlet = inlets_.find(port.get());
        if (inlet == inlets_.end()) continue;
        inlet->second.receive(run_, clock, [&](Value value) {
            if (state() != LifeState::active) return;
            static_cast<void>(
                deliver(*port, Write{path(*this, *port), std::move(value)}, {Actor::Kind::network, host_}));
        });
    }
}

}  // namespace nezumi::dds

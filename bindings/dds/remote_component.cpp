// Ports come when connections ask for them, and stay.
#include "bindings/dds/remote_component.hpp"

#include <fmt/format.h>

#include <utility>

namespace nezumi::dds {

RemoteComponent::RemoteComponent(std::string_view host, std::string_view component, std::function<double()> clock)
    : Device(fmt::format("{}/{}", host, component), "RemoteComponent"), host_(host), clock_(std::move(clock)) {}

Port& RemoteComponent::port(const std::string& name, std::size_t type, Direction direction) {
    if (Port* found = find_port(name)) return *found;
    const std::string doc = fmt::format("of host {}", host_);
    if (direction == Direction::in) return *in_ports_.emplace_back(make_in_port(type, name, doc, 0));
    return *out_ports_.emplace_back(make_out_port(type, name, doc));
}

void RemoteComponent::receive(OutPortBase& port, std::unique_ptr<Reader> reader) {
    inlets_.erase(&port);
    if (reader != nullptr) inlets_.try_emplace(&port, port, std::move(reader), progress_[&port]);
}

const Counts* RemoteComponent::counts(const OutPortBase& port) const {
    const auto found = inlets_.find(&port);
    return found != inlets_.end() ? &found->second.counts() : nullptr;
}

void RemoteComponent::sense(const Time& now) {
    const double clock = clock_();
    for (auto& [port, inlet] : inlets_) {
        inlet.receive(now, run_, clock);
        if (state() != LifeState::active) inlet.port().discard();
    }
}

}  // namespace nezumi::dds

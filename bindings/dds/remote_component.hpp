// Represents another host's component in this system, with those of its ports that are connected.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "bindings/dds/port_topic.hpp"
#include "engine/components/component.hpp"
#include "engine/system/network.hpp"

namespace nezumi::dds {

class RemoteComponent final : public Device {
public:
    /// `clock`: [s], monotonic.
    RemoteComponent(std::string_view host, std::string_view component, std::function<double()> clock);

    const std::string& host() const { return host_; }
    /// Returns the port of this name; makes it if missing.
    Port& port(const std::string& name, const MessageType* type, Direction direction);

    /// From now on, messages of `reader` are written to this out-port; nullptr: none.
    void receive(OutPortBase& port, std::unique_ptr<Reader> reader);
    bool receives(const OutPortBase& port) const { return inlets_.contains(&port); }
    /// Sets the run of the host whose messages count; none: the host is missing.
    void set_run(std::optional<std::uint64_t> run) { run_ = run; }
    /// Statistics of this port's messages; nullptr if it receives nothing.
    const Counts* counts(const OutPortBase& port) const;

    /// Writes the messages received since the last tick, as acts of the other host. Drops them while this component is
    /// not ACTIVE.
    void receive(const MessageDoor& deliver);

    /// Empty, because `receive` has written the messages before the tick.
    void sense(const Time& /*now*/) override {}
    /// Empty, because an `Outlet` sends the messages of the local port that is connected to an in-port.
    void actuate(const Time& /*now*/) override {}

private:
    std::string host_;
    std::function<double()> clock_;
    std::map<const OutPortBase*, Progress> progress_;
    std::map<const OutPortBase*, Inlet> inlets_;
    std::optional<std::uint64_t> run_;
};

}  // namespace nezumi::dds

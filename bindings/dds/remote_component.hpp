// The local representative of another host's component, with the ports that are connected here.
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

    /// From now on this out-port gives the messages of `reader`; nullptr: none.
    void receive(OutPortBase& port, std::unique_ptr<Reader> reader);
    bool receives(const OutPortBase& port) const { return inlets_.contains(&port); }
    /// The run of the host whose messages count; none: the host is missing.
    void set_run(std::optional<std::uint64_t> run) { run_ = run; }
    /// Statistics of this port's messages; nullptr if it receives nothing.
    const Counts* counts(const OutPortBase& port) const;

    /// Writes the messages received since the last tick, as acts of the other host. Does nothing while it is not
    /// ACTIVE.
    void receive(const MessageDoor& deliver);

    /// Received messages are written before the tick.
    void sense(const Time& /*now*/) override {}
    /// The in-ports' messages are sent where they are published: `Outlet`.
    void actuate(const Time& /*now*/) override {}

private:
    std::string host_;
    std::function<double()> clock_;
    std::map<const OutPortBase*, Progress> progress_;
    std::map<const OutPortBase*, Inlet> inlets_;
    std::optional<std::uint64_t> run_;
};

}  // namespace nezumi::dds

// A component of another host as this one sees it: the ports that are connected here.
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
    /// A port of this name, made when there is none.
    Port& port(const std::string& name, std::size_t type, Direction direction);

    /// From now on this out-port gives what comes from the other host; nullptr: nothing.
    void receive(OutPortBase& port, std::unique_ptr<Reader> reader);
    bool receives(const OutPortBase& port) const { return inlets_.contains(&port); }
    /// The start of the host whose messages count; none: it is not there.
    void set_run(std::optional<std::uint64_t> run) { run_ = run; }
    /// What became of the messages of this port; nullptr when it receives nothing.
    const Counts* counts(const OutPortBase& port) const;

    /// Has what came since the last tick written, as acts of the other host; nothing while this is not ACTIVE.
    void receive(const MessageDoor& deliver);

    /// What comes is there before the tick.
    void sense(const Time& /*now*/) override {}
    /// What its in-ports take is sent where it is published: `Outlet`.
    void actuate(const Time& /*now*/) override {}

private:
    std::string host_;
    std::function<double()> clock_;
    std::map<const OutPortBase*, Progress> progress_;
    std::map<const OutPortBase*, Inlet> inlets_;
    std::optional<std::uint64_t> run_;
};

}  // namespace nezumi::dds

// The connections between ports of a system's components.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/components/component.hpp"

namespace nezumi {

/// A connection between two ports.
struct Connection {
    Component* from_component;
    OutPortBase* from;
    Component* to_component;
    InPortBase* to;
    std::uint64_t number;  ///< number of the connection; if it is made again, it keeps its number
};

/// "name.port".
std::string path(const Component& component, const Port& port);

/// The names of a component's ports in one direction, in the order of declaration.
std::vector<std::string_view> port_names(const Component& component, Direction direction);

class Wiring {
public:
    /// All connections, in the order of their numbers.
    const std::vector<Connection>& connections() const { return connections_; }

    /// Connects an out-port to an in-port, by their names. The error has the nearest name, or the port that would fit.
    /// With the number of a former connection, the new one gets the position of the former.
    Expected<Connection> connect(Component& from, std::string_view out, Component& to, std::string_view in,
                                 std::optional<std::uint64_t> number = std::nullopt);
    /// Removes a connection. Returns whether there was one.
    bool disconnect(const Port& from, const Port& to);
    /// Removes all connections of a port. Messages that it has published still arrive.
    void disconnect_all(const Port& port, const Time& now);
    /// Removes all connections of a component. Messages that it has published still arrive.
    void disconnect_all(const Component& component, const Time& now);
    /// "name.port" of the ports at the other ends, including those of a companion port.
    std::vector<std::string> peers(const Port& port) const;

private:
    template <class Leaves, class Meets>
    void drop(const Time& now, const Leaves& leaves, const Meets& meets);

    std::vector<Connection> connections_;
    std::uint64_t made_ = 0;
};

}  // namespace nezumi

// Makes connections; errors suggest the most similar name.
#include "engine/system/wiring.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/list.hpp"

namespace nezumi {
namespace {

// The error for a missing port, with the most similar name, otherwise with all names.
std::string no_port(const Component& component, Direction direction, std::string_view name) {
    const std::string_view kind = direction == Direction::in ? "in-port" : "out-port";
    const auto names = port_names(component, direction);
    std::string hint = did_you_mean(name, names);
    if (hint.empty() && !names.empty()) hint = fmt::format("; it has {}", fmt::join(names, ", "));
    return fmt::format("{} has no {} '{}'{}", component.name(), kind, shown(name), hint);
}

// Names the first port at either end with a matching type, as the end of a sentence.
std::string fitting_port(const Component& from, const Port& out, const Component& to, const Port& in) {
    for (const auto& port : to.in_ports()) {
        if (port != &in && port->type() == out.type()) return fmt::format(" (did you mean '{}'?)", path(to, *port));
    }
    for (const auto& port : from.out_ports()) {
        if (port != &out && port->type() == in.type()) return fmt::format(" (did you mean '{}'?)", path(from, *port));
    }
    return "";
}

std::string wrong_direction(const Component& from, const Port& first, const Component& to, const Port& second) {
    const auto told = [](const Component& component, const Port& port) {
        return fmt::format("{} ({}) is an {}", path(component, port), port.type_name(),
                           port.direction() == Direction::in ? "in-port" : "out-port");
    };
    std::string hint = fitting_port(from, first, to, second);
    if (first.direction() == Direction::in && second.direction() == Direction::out)
        hint = fmt::format(" (did you mean connect(\"{}\", \"{}\")?)", path(to, second), path(from, first));
    return fmt::format("connect goes from an out-port to an in-port: {}, {}{}", told(from, first), told(to, second),
                       hint);
}

}  // namespace

std::string path(const Component& component, const Port& port) { return component.name() + "." + port.name(); }

std::vector<std::string_view> port_names(const Component& component, Direction direction) {
    std::vector<std::string_view> names;
    if (direction == Direction::in) {
        for (const auto& port : component.in_ports()) names.push_back(port->name());
    } else {
        for (const auto& port : component.out_ports()) names.push_back(port->name());
    }
    return names;
}

Expected<Connection> Wiring::connect(Component& from, std::string_view out_name, Component& to,
                                     std::string_view in_name, std::optional<std::uint64_t> number) {
    OutPortBase* out = from.find_out_port(out_name);
    InPortBase* in = to.find_in_port(in_name);
    const Port* first = from.find_port(out_name);
    const Port* second = to.find_port(in_name);
    if (first == nullptr) return failure(no_port(from, Direction::out, out_name));
    if (second == nullptr) return failure(no_port(to, Direction::in, in_name));
    if (out == nullptr || in == nullptr) return failure(wrong_direction(from, *first, to, *second));
    if (out->type() != in->type()) {
        return failure(fmt::format("types differ: {} is {}, {} is {}{}", path(from, *out), out->type_name(),
                                   path(to, *in), in->type_name(), fitting_port(from, *out, to, *in)));
    }
    const auto is_same = [&](const Connection& c) { return c.from == out && c.to == in; };
    if (std::any_of(connections_.begin(), connections_.end(), is_same))
        return failure(fmt::format("{} is connected to {} already", path(from, *out), path(to, *in)));
    if (!number) {
        in->connect(*out);
        return connections_.emplace_back(Connection{&from, out, &to, in, made_++});
    }
    const auto place = std::upper_bound(connections_.begin(), connections_.end(), *number,
                                        [](std::uint64_t own, const Connection& c) { return own < c.number; });
    std::vector<const OutPortBase*> before;
    for (auto each = connections_.begin(); each != place; ++each) {
        if (each->to == in) before.push_back(each->from);
    }
    in->connect(*out, before);
    return *connections_.insert(place, {&from, out, &to, in, *number});
}

bool Wiring::disconnect(const Port& from, const Port& to) {
    const auto found = std::find_if(connections_.begin(), connections_.end(),
                                    [&](const Connection& c) { return c.from == &from && c.to == &to; });
    if (found == connections_.end()) return false;
    found->to->disconnect(*found->from);
    connections_.erase(found);
    return true;
}

// Removes the connections for which `meets` is true. Messages already sent over those for which `leaves` is true still
// arrive.
template <class Leaves, class Meets>
void Wiring::drop(const Time& now, const Leaves& leaves, const Meets& meets) {
    for (const Connection& connection : connections_) {
        if (leaves(connection)) connection.to->latch(now);
        if (meets(connection)) connection.to->disconnect(*connection.from);
    }
    std::erase_if(connections_, meets);
}

void Wiring::disconnect_all(const Port& port, const Time& now) {
    drop(
        now, [&](const Connection& c) { return c.from == &port; },
        [&](const Connection& c) { return c.from == &port || c.to == &port; });
}

void Wiring::disconnect_all(const Component& component, const Time& now) {
    drop(
        now, [&](const Connection& c) { return c.from_component == &component; },
        [&](const Connection& c) { return c.from_component == &component || c.to_component == &component; });
}

std::vector<std::string> Wiring::peers(const Port& port) const {
    std::vector<std::string> all;
    const auto add = [&](const Component& component, const Port& peer) {
        std::string name = path(component, peer);
        add_once(all, std::move(name));
    };
    for (const Connection& c : connections_) {
        if (c.from == &port) add(*c.to_component, *c.to);
        if (c.to == &port) add(*c.from_component, *c.from);
        const InPortBase* companion = c.to->companion_for(*c.from);
        if (companion == nullptr) continue;
        if (c.from->companion() == &port) add(*c.to_component, *companion);
        if (companion == &port) add(*c.from_component, *c.from->companion());
    }
    return all;
}

}  // namespace nezumi

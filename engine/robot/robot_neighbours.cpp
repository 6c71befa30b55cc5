// Ports of a robot for the robots around it: what it sees of them, and what it says to them.
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/robot/robot.hpp"

namespace nezumi {

Expected<void> Robot::add_neighbours(const PortSpec& port, const std::vector<std::size_t>& sensors) {
    for (const std::size_t i : sensors) {
        if (spec_.sensors[i].kind != SensorSpec::Kind::neighbours)
            return failure(fmt::format("a NeighbourSeq carries neighbours, and '{}' is another kind of sensor",
                                       spec_.sensors[i].name));
    }
    const std::string& name = spec_.sensors[sensors.front()].name;
    if (port.type != "NeighbourSeq")
        return failure(fmt::format("'{}' sees neighbours: its type is NeighbourSeq, not {}", name, port.type));
    if (sensors.size() > 1) return failure(fmt::format("'{}' needs its own port", name));
    if (port.quantity != PortSpec::Quantity::value)
        return failure(fmt::format("'{}' is a neighbours sensor, which has no `quantity`", name));
    auto& made = add_out_port<std::vector<Neighbour>>(port.name, port.doc);
    made.set_rate(port.rate);
    neighbour_ports_.push_back({&made, sensors.front(), port.rate});
    return {};
}

void Robot::publish_neighbours(const Time& now) {
    if (is_real()) return;
    for (const NeighbourPort& each : neighbour_ports_) {
        if (!is_due_at(each.rate, now)) continue;
        const auto seen = body_->neighbours(each.sensor);
        each.port->next_pending().assign(seen.begin(), seen.end());
    }
}

void Robot::take_message(const Time& now) {
    if (say_in_->is_new()) {
        const std::vector<double>& given = say_in_->read();
        const auto length = std::min(given.size(), RobotBody::longest_message);
        if (given.size() > length && !std::exchange(said_long_, true))
            log(LogLevel::warn,
                fmt::format(
                    "input '{}' got {} numbers, and a robot can say only {}: the others are not sent (reported once)",
                    say_in_->name(), given.size(), length));
        say(std::span(given).first(length));
    } else if (is_quiet_when_silent_ && say_in_->is_silent(now.seconds)) {
        say({});
    }
}

void Robot::say(std::span<const double> message) {
    if (std::equal(message.begin(), message.end(), message_.begin(), message_.end())) return;
    message_.assign(message.begin(), message.end());
    body_->say(message_);
}

}  // namespace nezumi

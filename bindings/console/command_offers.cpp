// Completes the arguments of a command as its row in the table of commands describes.
#include "bindings/console/command_offers.hpp"

#include <algorithm>
#include <utility>

#include "bindings/console/console_fields.hpp"
#include "bindings/lua/live/hosts_object.hpp"
#include "bindings/lua/live/robot_acts.hpp"
#include "bindings/lua/stubs/record_annotations.hpp"

namespace nezumi {
namespace {

using Names = std::vector<std::string>;

// The command that is called; null for any other call.
const ConsoleCommand* command_of(const TextAtCursor& call) {
    return call.callee.separator == 0 ? find_console_command(call.word) : nullptr;
}

Names joined(Names all, const Names& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Names port_paths(const System& system, bool in, bool out, std::string_view type = "") {
    Names paths;
    for (const Component* component : system.components()) {
        for (const Port* port : ports_of(*component)) {
            const bool fits = type.empty() || port->type_name() == type;
            if (fits && (port->direction() == Direction::in ? in : out))
                paths.push_back(component->name() + "." + port->name());
        }
    }
    return paths;
}

// The in-ports that fit the first argument.
Names fitting_ports(const System& system, const TextAtCursor& text, bool offered) {
    const auto source = system.port(text.first);
    const std::string type = source ? std::string((*source)->type_name()) : offered_type(system, text.first);
    Names paths = port_paths(system, true, false, type);
    return offered ? joined(std::move(paths), offered_ports(system, true, false, type)) : paths;
}

}  // namespace

Names names_of(const System& system) {
    Names names;
    for (const auto& component : system.components()) {
        if (!is_remote(component->name())) names.push_back(component->name());
    }
    return names;
}

Offer offer_at(const TextAtCursor& call) {
    const ConsoleCommand* command = command_of(call);
    if (command == nullptr || command->offers.empty() || call.argument > command->most) return Offer::nothing;
    return command->offers[std::min(static_cast<std::size_t>(call.argument), command->offers.size()) - 1];
}

Names texts_at(const System& system, const TextAtCursor& text) {
    if (!text.field.empty()) return {};
    switch (offer_at(text)) {
        case Offer::nothing:
        case Offer::value: return {};
        case Offer::component: return names_of(system);
        case Offer::port: return port_paths(system, true, true);
        case Offer::source: return joined(port_paths(system, false, true), offered_ports(system, false, true));
        case Offer::any_port: return joined(port_paths(system, true, true), offered_ports(system, true, true));
        case Offer::target: return fitting_ports(system, text, true);
        case Offer::in_port: return fitting_ports(system, text, false);
        case Offer::carried: {
            Names carried = joined(marker_names(system), thing_names(system));
            for (const Robot* robot : system.robots()) carried.push_back(robot->name());
            return carried;
        }
        case Offer::removable: return joined(marker_names(system), names_of(system));
        case Offer::log_level: return log_level_names();
        case Offer::anyway: return {"anyway"};
        case Offer::max: return {"max"};
        case Offer::topic: break;
    }
    Names names = names_of(system);
    for (const ConsoleCommand& each : console_commands()) names.emplace_back(each.name);
    return names;
}

Names fields_of_table(const TextAtCursor& call) {
    const ConsoleCommand* command = command_of(call);
    if (command == nullptr || command->table.record.empty() || call.argument < command->table.from) return {};
    Names fields;
    const auto add_of = [&](const std::vector<RecordShape>& records) {
        for (const RecordShape& record : records) {
            if (record.name != command->table.record) continue;
            for (const FieldRow& row : record.rows) fields.push_back(row.name);
        }
    };
    add_of(file_records({}));
    add_of(console_records());
    return fields;
}

}  // namespace nezumi

// The table of all members of ports.
#include <fmt/format.h>

#include <limits>

#include "engine/tree/read_member.hpp"

namespace nezumi {
namespace {

using namespace reads;

std::string path_of_port(const TreeNode& node) { return path(*node.component(), *node.port()); }

std::vector<std::string> peers_of(const TreeNode& node) { return node.system().peers(*node.component(), *node.port()); }

// Adds "NAME: KIND [UNIT]" for every value in a message; for a sequence or an array "NAME[]: KIND [UNIT]".
void add_fields(const Type& type, const std::string& name, std::string_view unit, std::vector<std::string>& fields) {
    for (const Type::Field& field : type.fields)
        add_fields(*field.type, name + (name.empty() ? "" : ".") + std::string(field.name), field.unit, fields);
    const bool is_several = type.kind == Type::Kind::sequence || type.kind == Type::Kind::array;
    const Type& single = is_several ? *type.element : type;
    if (!single.is_single()) return;
    const std::string_view kind = single.is_integer()                      ? "integer"
                                  : single.is_floating()                   ? "number"
                                  : single.kind == Type::Kind::boolean     ? "boolean"
                                  : single.kind == Type::Kind::text        ? "text"
                                  : single.kind == Type::Kind::enumeration ? "text"
                                                                           : "octets";
    fields.push_back(
        fmt::format("{}{}: {}{}", name, is_several ? "[]" : "", kind, unit.empty() ? "" : fmt::format(" [{}]", unit)));
}

std::vector<std::string> fields_of_port(const TreeNode& node) {
    std::vector<std::string> fields;
    add_fields(*node.port()->type()->payload, "", "", fields);
    return fields;
}

const std::vector<MemberInfo>& all_port_members() {
    static const std::vector<MemberInfo> members{
        {.name = "age",
         .type = "number",
         .doc = "time since the stamp of the latest message [s]; math.huge before the first message",
         .value = of_node<[](const TreeNode& node) { return port_age(node.system(), *node.port()); }>},
        {.name = "connected",
         .type = "boolean",
         .doc = "whether another port is connected to this port",
         .value = of_node<[](const TreeNode& node) { return !peers_of(node).empty(); }>},
        {.name = "count",
         .type = "integer",
         .doc = "number of messages since the start",
         .value = of_port<[](const Port& port) { return static_cast<std::int64_t>(port.count()); }>},
        {.name = "direction",
         .type = R"("in"|"out")",
         .doc = "whether the component reads or writes the port",
         .value =
             of_port<[](const Port& port) { return std::string(port.direction() == Direction::in ? "in" : "out"); }>},
        {.name = "doc",
         .type = "string",
         .doc = "description of the port",
         .value = of_port<[](const Port& port) { return port.doc(); }>},
        {.name = "drop",
         .type = "fun(self: Port)",
         .called = true,
         .most = 0,
         .usage = "()",
         .doc = "blocks all messages until release"},
        {.name = "fields",
         .type = "string[]",
         .doc = R"(fields of the messages, as in "position.x: number [m]", "ranges[]: number [m]")",
         .value = of_node<fields_of_port>},
        {.name = "freeze",
         .type = "fun(self: Port)",
         .called = true,
         .most = 0,
         .usage = "()",
         .doc = "repeats the present value until release"},
        {.name = "hold",
         .type = "fun(self: Port, value: any, options?: HoldOptions)",
         .called = true,
         .most = 2,
         .usage = "(value, { take = true })",
         .doc = "sends only this value until release"},
        {.name = "holder",
         .type = "string?",
         .doc = "the actor that holds, drops or freezes the port, or nil",
         .value = of_node<[](const TreeNode& node) {
             const Actor* holder = node.system().holder(path_of_port(node));
             return holder != nullptr ? NodeValue{Value{to_text(*holder)}} : NodeValue{};
         }>},
        {.name = "inject",
         .type = "fun(self: Port, value: any)",
         .called = true,
         .most = 1,
         .usage = "(value)",
         .doc = "delivers one message, as from a connection"},
        {.name = "name",
         .type = "string",
         .doc = "the port's name",
         .value = of_port<[](const Port& port) { return port.name(); }>},
        {.name = "note",
         .type = "string",
         .doc = "a note from the robot, for example that commands are ignored",
         .value = of_port<[](const Port& port) { return port.note(); }>},
        {.name = "override",
         .type = "string",
         .doc = R"("held", "dropped", "frozen" or "")",
         .value = of_port<[](const Port& port) { return std::string(to_text(port.override())); }>},
        {.name = "path", .type = "string", .doc = R"("name.port")", .value = of_node<path_of_port>},
        {.name = "peers",
         .type = "string[]",
         .doc = "the ports that are connected to this port",
         .value = of_node<peers_of>},
        {.name = "release",
         .type = "fun(self: Port)",
         .called = true,
         .most = 0,
         .usage = "()",
         .doc = "ends a hold, drop or freeze"},
        {.name = "stale",
         .type = "boolean",
         .doc = "whether a message is overdue: none came for three periods of the sender, at least 0.1 s, or for 0.5 s "
                "if the sender declares no rate",
         .value = of_node<[](const TreeNode& node) { return is_stale(node.system(), *node.port()); }>},
        {.name = "tm",
         .type = "number",
         .doc = "stamp of the latest message [s], 0 before the first message",
         .value = of_port<[](const Port& port) { return port.tm(); }>},
        {.name = "type",
         .type = "MessageType",
         .doc = "the port's message type",
         .value = of_port<[](const Port& port) { return std::string(port.type_name()); }>},
        {.name = "unread",
         .type = "boolean",
         .doc = "of an in-port: whether there is a message that the component has not read",
         .value = of_port<[](const Port& port) {
             return port.direction() == Direction::in && static_cast<const InPortBase&>(port).is_new();
         }>},
        {.name = "value",
         .type = "any",
         .doc = "a copy of the latest message; the message stays unread. Before the first message, the zero value of "
                "its type",
         .value = of_port<[](const Port& port) { return port.value(); }>},
        {.name = "write",
         .type = "fun(self: Port, value: any)",
         .called = true,
         .most = 1,
         .usage = "(value)",
         .doc = "an out-port: publishes a message as if the component had written it; an in-port: the same as inject"},
    };
    return members;
}

}  // namespace

std::span<const MemberInfo> port_members() { return all_port_members(); }

double port_age(const System& system, const Port& port) {
    return port.count() == 0 ? std::numeric_limits<double>::infinity() : system.now().seconds - port.tm();
}

bool is_stale(const System& system, const Port& port) {
    const double now = system.now().seconds;
    return port.direction() == Direction::in ? static_cast<const InPortBase&>(port).is_stale(now)
                                             : static_cast<const OutPortBase&>(port).is_stale(now);
}

std::string_view to_text(Override override) {
    constexpr std::string_view names[] = {"", "held", "dropped", "frozen"};
    return names[static_cast<int>(override)];
}

}  // namespace nezumi

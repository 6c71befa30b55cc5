// Writes the classes of values and ports from the descriptions of the message types.
#include "bindings/lua/stubs/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "bindings/lua/script/declaration_fields.hpp"
#include "bindings/lua/stubs/record_annotations.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/devices/wired_device.hpp"
#include "engine/messages/message_fields.hpp"
#include "engine/ports/payload.hpp"
#include "engine/tree/member.hpp"
#include "engine/world/robot_fields.hpp"

namespace nezumi {
namespace {

// Values that scripts read are complete; in values that they write, fields may be omitted.
enum class Purpose { read, write };

// "sensor_msgs/Imu" is the class sensor_msgs.Imu.
std::string class_name(std::string name) {
    std::replace(name.begin(), name.end(), '/', '.');
    return name;
}

std::string lua_type_of(const Type& type, Purpose use) {
    if (type.element != nullptr) {
        const std::string element = lua_type_of(*type.element, use);
        return (element.find('|') != std::string::npos ? "(" + element + ")" : element) + "[]";
    }
    if (type.is_integer()) return "integer";
    switch (type.kind) {
        case Type::Kind::enumeration: {
            std::string text;
            for (const std::string& choice : type.choices) text += (text.empty() ? "" : "|") + lua_quoted(choice);
            return text;
        }
        case Type::Kind::boolean: return "boolean";
        case Type::Kind::text:
        case Type::Kind::octets: return "string";
        case Type::Kind::structure: return class_name(type.name) + (use == Purpose::write ? ".Written" : "");
        default: return "number";
    }
}

// "[m/s] speed along the robot's x axis", or shorter if parts are missing.
std::string remark(const Type::Field& field) {
    std::string text;
    if (!field.unit.empty()) text = fmt::format(" [{}]", field.unit);
    if (!field.doc.empty()) text += fmt::format(" {}", field.doc);
    if (field.limits != nullptr) return text + limits_text(*field.limits);
    if (!field.type->single().is_integer()) return text;
    const auto [min, max] = field.type->single().integer_range();
    return text + fmt::format(" {}..{}", min, max);
}

// Adds a structure after the structures that it contains, each once.
void add_structure(std::string& text, const Type& type, std::set<std::string_view>& done) {
    if (type.element != nullptr) return add_structure(text, *type.element, done);
    if (type.kind != Type::Kind::structure || !done.insert(type.name).second) return;
    for (const Type::Field& field : type.fields) add_structure(text, *field.type, done);
    for (const Purpose use : {Purpose::read, Purpose::write}) {
        text += fmt::format("---@class (exact) {}{}\n", class_name(type.name), use == Purpose::write ? ".Written" : "");
        for (const Type::Field& field : type.fields) {
            text += fmt::format("---@field {}{} {}{}\n", field.name, use == Purpose::write ? "?" : "",
                                lua_type_of(*field.type, use), remark(field));
        }
        text += "\n";
    }
}

std::string limits(const Type& type) {
    if (!type.is_integer()) return "";
    const auto [min, max] = type.integer_range();
    return fmt::format(" from {} to {}", min, max);
}

void add_ports(std::string& text, const MessageType& message) {
    text += fmt::format(
        "---An in-port of {0}: {1}{2}.\n"
        "---@class {0}.In : InPort\n"
        "---@field read fun(self: {0}.In): {3}\n\n"
        "---An out-port of {0}: {1}{2}.\n"
        "---@class {0}.Out : OutPort\n"
        "---@field write fun(self: {0}.Out, value: {4})\n\n",
        class_name(message.name), message.doc, limits(message.payload->single()),
        lua_type_of(*message.payload, Purpose::read), lua_type_of(*message.payload, Purpose::write));
}

// `input` or `output` with an overload for each type, so that the port has its type's class.
void add_word(std::string& text, std::string_view word, std::string_view suffix, std::string_view doc,
              const std::vector<const MessageType*>& messages) {
    text += fmt::format("---{}\n", doc);
    for (const MessageType* message : messages) {
        text += fmt::format(
            "---@overload fun(name: string, type: \"{0}\", doc?: string, options?: {2}.{1}Options): {2}.{1}\n",
            message->name, suffix, class_name(message->name));
    }
    text += fmt::format("function {}(name, type, doc, options) end\n\n", word);
}

std::string annotation(const MemberInfo& member) {
    return fmt::format("---@field {} {} {}{}\n", member.name, member.type, member.robot ? "of robots: " : "",
                       member.doc);
}

// "integer", or "integer[]" of "array of integers".
std::string annotated_type(const Value& value) {
    constexpr std::string_view array = "array of ";
    const std::string text = type_text(value);
    return text.starts_with(array) ? text.substr(array.size(), text.size() - array.size() - 1) + "[]" : text;
}

// `serial { ... }` and the like, in robot files.
std::string device_annotations() {
    std::string text = "---@class Device\n\n";
    for (const DeviceKind& kind : device_kinds()) {
        text += fmt::format("---@class (exact) {}Fields\n", kind.type);
        for (const ParameterSpec& each : kind.parameters) {
            if (each.name == "measures_only") continue;
            text += fmt::format("---@field {}? {}{}{} {}\n", each.name, annotated_type(each.initial),
                                each.name == "safe" ? "|false" : "",
                                each.unit.empty() ? "" : fmt::format(" [{}]", each.unit), each.doc);
        }
        text += fmt::format(
            "\n---A device of a robot whose driver is a script.\n---@param fields {}Fields\n---@return Device\n"
            "function {}(fields) end\n\n",
            kind.type, kind.word);
    }
    return text;
}

}  // namespace

std::string annotations(const std::vector<RecordShape>& more, const PeerWords& peers,
                        const std::vector<const MessageType*>& defined) {
    std::vector<const MessageType*> messages;
    for (const MessageType& each : compiled_message_types()) messages.push_back(&each);
    messages.insert(messages.end(), defined.begin(), defined.end());
    std::string text =
        "---@meta\n"
        "--- What behaviours, systems and scenarios of nezumi are made of, for the Lua language server.\n"
        "--- Written by `nezumi types --lua`; do not edit.\n\n"
        "---@alias MessageType";
    for (const MessageType* message : messages)
        text += fmt::format("{}\"{}\"", message == messages.front() ? " " : "|", message->name);
    text += "\n\n";
    std::set<std::string_view> done;
    for (const MessageType* message : messages) add_structure(text, *message->payload, done);
    text +=
        "---@class InPort\n"
        "---@field is_new boolean there is an unread message\n"
        "---@field tm number [s] stamp of the value, 0 before the first message\n"
        "---@field age number [s] now() - tm, math.huge before the first message\n"
        "---@field connected boolean\n"
        "---@field stale boolean no message came for three periods of its sender, or none can come\n\n"
        "---@class OutPort\n\n";
    for (const MessageType* message : messages) {
        add_ports(text, *message);
        RecordShape options = shape_of_record<PortDeclaration>();
        for (FieldRow& row : options.rows) {
            if (row.name == "safe") row.type = lua_type_of(*message->payload, Purpose::write);
        }
        for (const std::string_view kind : Describe<PortDeclaration>::kinds) {
            text += annotation(
                options, fmt::format("{}.{}Options", class_name(message->name), kind == "input" ? "In" : "Out"), kind);
        }
    }
    add_word(text, "input", "In",
             "Declares an in-port: `local range = input(\"range\", \"TimedShortSeq\", \"what it is\")`.", messages);
    add_word(text, "output", "Out",
             "Declares an out-port: `local target = output(\"target\", \"TimedVelocity2D\", \"what it is\")`.",
             messages);
    text += "---@alias ParameterValue boolean|integer|number|string|boolean[]|integer[]|number[]|string[]\n\n";
    for (const RecordShape& record : file_records(peers)) text += annotation(record);
    for (const RecordShape& record : more) text += annotation(record);
    text += detail::behavior_annotations;
    text +=
        "---@class Thing\n\n"
        "---@class Maze: Thing\n"
        "---@field columns integer cells from west to east\n"
        "---@field rows integer cells from south to north\n"
        "---@field start integer[] column and row, from 1, of the cell with S, otherwise of the south-west cell\n"
        "---@field direction integer side on which the start cell is open, in quarter turns from east: 1 is north\n"
        "---@field goal integer[] column and row of each cell with G, otherwise of the cells in the middle\n"
        "---@field pose table x, y and heading of a robot at the start\n\n" +
        system_word_annotations(peers, false);
    text += fmt::format("---{}\n---@param fields {}\n---@return table\nfunction {}(fields) end\n\n",
                        Describe<RobotSpec>::doc, class_of(Describe<RobotSpec>::name), Describe<RobotSpec>::name);
    text += device_annotations();
    text += "---A port as seen from outside: reading it here does not consume messages.\n---@class Port\n";
    for (const MemberInfo& member : port_members()) text += annotation(member);
    text += "\n---@class Component\n";
    for (const MemberInfo& member : component_members()) text += annotation(member);
    text += "---@field [string] any its ports and commands\n\n";
    return text + detail::scenario_annotations + "\n" + system_word_annotations(peers, true);
}

}  // namespace nezumi

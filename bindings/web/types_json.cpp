// Collects types by following each type to the types of its fields.
#include "bindings/web/types_json.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "bindings/web/web_frame.hpp"
#include "engine/live/script_host.hpp"
#include "engine/ports/payload.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const Type& type) {
    switch (type.kind) {
        // A message type from a file may be the type of a port, with a stamp, or a field of another message, without
        // one. "payload" means without the stamp.
        case Type::Kind::structure: return type.message != nullptr ? "payload " + type.name : type.name;
        case Type::Kind::sequence: return "sequence<" + name_of(*type.element) + ">";
        case Type::Kind::array: return fmt::format("array<{},{}>", name_of(*type.element), type.length);
        case Type::Kind::enumeration: return fmt::format("enum<{}>", fmt::join(type.choices, ","));
        case Type::Kind::octets: return "sequence<uint8>";
        case Type::Kind::text: return "string";
        case Type::Kind::boolean: return "bool";
        case Type::Kind::float32: return "float";
        case Type::Kind::float64: return "double";
        default: return (type.kind <= Type::Kind::int64 ? "int" : "uint") + std::to_string(8 * type.size);
    }
}

void add(Json& types, const Type& type) {
    if (type.element != nullptr) return add(types, *type.element);
    const std::string name = name_of(type);
    if (type.kind != Type::Kind::structure || types.contains(name)) return;
    Json fields = Json::array();
    for (const Type::Field& field : type.fields) {
        fields.push_back(
            {{"name", field.name}, {"type", name_of(*field.type)}, {"unit", field.unit}, {"doc", field.doc}});
        add(types, *field.type);
    }
    types[name] = std::move(fields);
}

void add_message(Json& types, const MessageType& message) {
    add(types, *message.payload);
    Json fields = Json::array();
    fields.push_back({{"name", "tm"}, {"type", name_of(type_of<CdrTime>())}, {"unit", ""}, {"doc", "its stamp"}});
    const std::string payload = name_of(*message.payload);
    if (message.payload->kind == Type::Kind::structure && (!message.is_compiled() || payload == message.name)) {
        // The fields of the payload follow the time stamp.
        for (const Json& field : types[payload]) fields.push_back(field);
    } else {
        fields.push_back({{"name", "data"}, {"type", payload}, {"unit", ""}, {"doc", message.doc}});
    }
    types[message.name] = std::move(fields);
}

}  // namespace

Json types_to_json() {
    Json types = Json::object();
    add(types, type_of<CdrTime>());
    for (const MessageType& message : compiled_message_types()) add_message(types, message);
    add(types, type_of<WebFrame>());
    add(types, type_of<WebPicture>());
    return types;
}

Json defined_types_to_json(const System& system) {
    Json types = Json::object();
    for (const MessageType* message : defined_messages(system)) add_message(types, *message);
    return types;
}

}  // namespace nezumi::web

// Follows each type to the types of its fields.
#include "bindings/web/types_json.hpp"

#include <nlohmann/json.hpp>
#include <string>

#include "bindings/web/web_frame.hpp"
#include "engine/ports/payload.hpp"
#include "engine/values/cdr.hpp"

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const Type& type) {
    switch (type.kind) {
        case Type::Kind::structure: return type.name;
        case Type::Kind::sequence: return "sequence<" + name_of(*type.element) + ">";
        case Type::Kind::octets: return "sequence<uint8>";
        case Type::Kind::text: return "string";
        case Type::Kind::boolean: return "bool";
        case Type::Kind::float32: return "float";
        case Type::Kind::float64: return "double";
        default: return (type.kind <= Type::Kind::int64 ? "int" : "uint") + std::to_string(8 * type.size);
    }
}

void add(Json& types, const Type& type) {
    if (type.kind == Type::Kind::sequence) return add(types, *type.element);
    if (type.kind != Type::Kind::structure || types.contains(type.name)) return;
    Json fields = Json::array();
    for (const Type::Field& field : type.fields) {
        fields.push_back(
            {{"name", field.name}, {"type", name_of(*field.type)}, {"unit", field.unit}, {"doc", field.doc}});
        add(types, *field.type);
    }
    types[type.name] = std::move(fields);
}

}  // namespace

Json types_to_json() {
    Json types = Json::object();
    add(types, type_of<CdrTime>());
    for (const MessageType& message : compiled_message_types()) {
        add(types, *message.payload);
        const std::string name(message.name);
        Json fields = Json::array();
        fields.push_back({{"name", "tm"}, {"type", name_of(type_of<CdrTime>())}, {"unit", ""}, {"doc", "its stamp"}});
        if (types.contains(name)) {
            // The payload has the name of its message: its fields follow the time stamp.
            for (const Json& field : types[name]) fields.push_back(field);
        } else {
            fields.push_back(
                {{"name", "data"}, {"type", name_of(*message.payload)}, {"unit", ""}, {"doc", message.doc}});
        }
        types[name] = std::move(fields);
    }
    add(types, type_of<WebFrame>());
    add(types, type_of<WebPicture>());
    return types;
}

}  // namespace nezumi::web

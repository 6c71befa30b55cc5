// The JSON must be exactly what rosidl writes for SHA-256: ", " and ": ", types by name, no default values.
#include "bindings/dds/ros/type_hash.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <array>
#include <cassert>
#include <map>
#include <utility>

namespace nezumi::ros {
namespace {

// The descriptions of types as JSON, by name.
using Descriptions = std::map<std::string_view, std::string>;

// `type_id` of type_description_interfaces/msg/FieldType; plus 48 for an array, plus 144 for an unbounded sequence.
int field_type(const Type& type) {
    switch (type.kind) {
        case Type::Kind::structure: return 1;
        case Type::Kind::int8: return 2;
        case Type::Kind::uint8: return 3;
        case Type::Kind::int16: return 4;
        case Type::Kind::uint16: return 5;
        case Type::Kind::int32: return 6;
        case Type::Kind::uint32: return 7;
        case Type::Kind::int64: return 8;
        case Type::Kind::uint64: return 9;
        case Type::Kind::float32: return 10;
        case Type::Kind::float64: return 11;
        case Type::Kind::boolean: return 15;
        case Type::Kind::text: return 17;
        case Type::Kind::array: return 48 + field_type(*type.element);
        case Type::Kind::sequence: return 144 + field_type(*type.element);
        case Type::Kind::octets: return 144 + 3;
        default: assert(false && "no type of ROS 2"); return 0;
    }
}

// Describes a type and all types that it contains.
void describe_type(const Type& type, Descriptions& all) {
    if (all.contains(type.name)) return;
    std::string fields;
    for (const Type::Field& field : type.fields) {
        const Type& single = field.type->element != nullptr ? *field.type->element : *field.type;
        if (single.kind == Type::Kind::structure) describe_type(single, all);
        fields += fmt::format(
            R"({}{{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": 0, "nested_type_name": "{}"}}}})",
            fields.empty() ? "" : ", ", field.name, field_type(*field.type), field.type->length, single.name);
    }
    all.emplace(type.name, std::move(fields));
}

std::string type_text(std::string_view name, std::string_view fields) {
    return fmt::format(R"({{"type_name": "{}", "fields": [{}]}})", name, fields);
}

}  // namespace

std::string type_hash(const Type& type) {
    Descriptions all;
    describe_type(type, all);
    std::string others;
    for (const auto& [other, fields] : all) {
        if (other != type.name) others += (others.empty() ? "" : ", ") + type_text(other, fields);
    }
    const std::string json = fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})",
                                         type_text(type.name, all.find(type.name)->second), others);
    std::array<unsigned char, crypto_hash_sha256_BYTES> digest{};
    crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(json.data()), json.size());
    std::string text = "RIHS01_";
    for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
    return text;
}

std::string dds_type_name(std::string_view name) {
    std::string text;
    for (const char c : name) text += c == '/' ? std::string("::") : std::string(1, c);
    const std::size_t last = text.rfind("::");
    return text.substr(0, last) + "::dds_" + text.substr(last) + "_";
}

}  // namespace nezumi::ros

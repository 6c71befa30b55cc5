// The JSON must be exactly what rosidl hashes: separators ", " and ": ", types sorted by name, no default values.
#include "bindings/dds/ros/type_hash.hpp"

#include <fmt/format.h>
#include <sodium.h>

#include <array>
#include <cassert>
#include <map>
#include <utility>

#include "engine/messages/msg_text.hpp"

namespace nezumi::ros {
namespace {

// The fields of each type as JSON, by the type's name.
using Descriptions = std::map<std::string_view, std::string>;

// The fields of type_description_interfaces/msg/FieldType. The id of an array is that of its element plus 48, of a
// bounded sequence plus 96, of an unbounded one plus 144.
struct FieldType {
    int id = 0;
    std::size_t capacity = 0;
    std::size_t text_capacity = 0;
    std::string_view nested{};
};

FieldType field_type(const Type& type, std::size_t most) {
    constexpr std::size_t unbounded = FieldLimits{}.length;
    switch (type.kind) {
        case Type::Kind::structure: return {1, 0, 0, ros_name(type)};
        case Type::Kind::int8: return {2};
        case Type::Kind::uint8: return {3};
        case Type::Kind::int16: return {4};
        case Type::Kind::uint16: return {5};
        case Type::Kind::int32: return {6};
        case Type::Kind::uint32:
        case Type::Kind::enumeration: return {7};
        case Type::Kind::int64: return {8};
        case Type::Kind::uint64: return {9};
        case Type::Kind::float32: return {10};
        case Type::Kind::float64: return {11};
        case Type::Kind::boolean: return {15};
        case Type::Kind::text: return most == unbounded ? FieldType{17} : FieldType{21, 0, most};
        case Type::Kind::octets: return most == unbounded ? FieldType{144 + 3} : FieldType{96 + 3, most};
        case Type::Kind::array: {
            FieldType found = field_type(*type.element, unbounded);
            found.id += 48;
            found.capacity = type.length;
            return found;
        }
        case Type::Kind::sequence: {
            FieldType found = field_type(*type.element, unbounded);
            found.id += most == unbounded ? 144 : 96;
            found.capacity = most == unbounded ? 0 : most;
            return found;
        }
        default: assert(false && "no type of ROS 2"); return {};
    }
}

// Describes a type and all types that it contains.
void describe_type(const Type& type, Descriptions& all) {
    if (all.contains(ros_name(type))) return;
    std::string fields;
    for (const Type::Field& field : type.fields) {
        const Type& single = field.type->element != nullptr ? *field.type->element : *field.type;
        if (single.kind == Type::Kind::structure) describe_type(single, all);
        const FieldType found =
            field_type(*field.type, field.limits != nullptr ? field.limits->length : FieldLimits{}.length);
        fields += fmt::format(
            R"({}{{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": {}, "nested_type_name": "{}"}}}})",
            fields.empty() ? "" : ", ", field.name, found.id, found.capacity, found.text_capacity, found.nested);
    }
    all.emplace(ros_name(type), std::move(fields));
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
        if (other != ros_name(type)) others += (others.empty() ? "" : ", ") + type_text(other, fields);
    }
    const std::string json = fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})",
                                         type_text(ros_name(type), all.find(ros_name(type))->second), others);
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

// The basic types of fields, and the compiled structures.
#include "engine/messages/definition.hpp"

#include <algorithm>
#include <array>

#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

using NamedKind = std::pair<std::string_view, const Type& (*)()>;
constexpr std::array single_kinds{NamedKind{"boolean", type_of<bool>},
                                  NamedKind{"octet", type_of<std::uint8_t>},
                                  NamedKind{"int8", type_of<std::int8_t>},
                                  NamedKind{"short", type_of<std::int16_t>},
                                  NamedKind{"long", type_of<std::int32_t>},
                                  NamedKind{"longlong", type_of<std::int64_t>},
                                  NamedKind{"ushort", type_of<std::uint16_t>},
                                  NamedKind{"ulong", type_of<std::uint32_t>},
                                  NamedKind{"ulonglong", type_of<std::uint64_t>},
                                  NamedKind{"float", type_of<float>},
                                  NamedKind{"double", type_of<double>},
                                  NamedKind{"string", type_of<std::string>},
                                  NamedKind{"bytes", type_of<Octets>}};

const Type* find_structure(const Type& within, std::string_view name) {
    const Type& type = within.single();
    if (type.kind != Type::Kind::structure) return nullptr;
    if (type.name == name) return &type;
    for (const Type::Field& field : type.fields) {
        if (const Type* found = find_structure(*field.type, name)) return found;
    }
    return nullptr;
}

}  // namespace

std::span<const std::string_view> field_kinds() {
    static const auto names = [] {
        std::array<std::string_view, single_kinds.size()> all;
        std::transform(single_kinds.begin(), single_kinds.end(), all.begin(),
                       [](const NamedKind& each) { return each.first; });
        return all;
    }();
    return names;
}

const Type* type_of_kind(std::string_view kind) {
    const auto found = std::find_if(single_kinds.begin(), single_kinds.end(),
                                    [&](const NamedKind& each) { return each.first == kind; });
    return found != single_kinds.end() ? &found->second() : nullptr;
}

std::span<const std::pair<std::string_view, std::string_view>> foreign_kinds() {
    static constexpr std::pair<std::string_view, std::string_view> kinds[] = {
        {"char", "octet"}, {"int8", "int8"},    {"uint8", "octet"},    {"int16", "short"},     {"uint16", "ushort"},
        {"int32", "long"}, {"uint32", "ulong"}, {"int64", "longlong"}, {"uint64", "ulonglong"}};
    return kinds;
}

const Type* compiled_payload(std::string_view name) {
    for (const MessageType& each : compiled_message_types()) {
        if (each.name == name) return each.payload;
        if (const Type* found = find_structure(*each.payload, name)) return found;
    }
    return nullptr;
}

}  // namespace nezumi

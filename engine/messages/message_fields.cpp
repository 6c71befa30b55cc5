// Describes the values of each field by its type and its limits.
#include "engine/messages/message_fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace nezumi {
namespace {

// The allowed values of a type in words. `numbers`: whether infinite numbers and NaN are allowed.
std::string values_of(const Type& type, Numbers numbers = Numbers::finite) {
    const bool many = type.element != nullptr;
    const Type& single = many ? *type.element : type;
    const std::string array = !many ? "" : type.length == 0 ? "array of " : fmt::format("array of {} ", type.length);
    if (many && single.element != nullptr) return array + values_of(single, numbers);
    const std::string_view plural = many ? "s" : "";
    if (single.is_integer()) {
        const auto [min, max] = single.integer_range();
        return fmt::format("{}integer{} from {} to {}", array, plural, min, max);
    }
    const bool any = numbers == Numbers::any;
    const std::string number = fmt::format("{}{}number{}", array, any ? "" : "finite ", plural);
    const std::string_view others = any ? ", also inf and nan" : "";
    switch (single.kind) {
        case Type::Kind::boolean: return many ? array + "booleans" : "true or false";
        case Type::Kind::float32: {
            constexpr float limit = std::numeric_limits<float>::max();
            return fmt::format("{} from {:.4g} to {:.4g}{}", number, -limit, limit, others);
        }
        case Type::Kind::float64: return fmt::format("{}{}", number, others);
        case Type::Kind::text: return fmt::format("{}string{}", array, plural);
        case Type::Kind::octets: return fmt::format("{}string{} of bytes", array, plural);
        case Type::Kind::enumeration: return array + fmt::format("{}", fmt::join(single.choices, " | "));
        default: return fmt::format("{}{}", array, single.name);
    }
}

void add_rows(std::vector<MessageField>& rows, const std::string& path, const Type& type) {
    for (const Type::Field& field : type.fields) {
        const std::string name = path + field.name;
        const bool many = field.type->element != nullptr;
        const Type& single = many ? *field.type->element : *field.type;
        const std::string limits = field.limits != nullptr ? limits_text(*field.limits) : "";
        rows.push_back({.path = name,
                        .values = values_of(*field.type, field.numbers) + limits,
                        .unit = field.unit,
                        .doc = field.doc,
                        .is_structure = !many && !single.fields.empty()});
        add_rows(rows, name + (many ? "[i]." : "."), single);
    }
}

}  // namespace

std::string limits_text(const FieldLimits& limits) {
    std::string text;
    if (std::isfinite(limits.min)) text += fmt::format(", from {}", limits.min);
    if (std::isfinite(limits.max)) text += fmt::format("{} up to {}", text.empty() ? "," : "", limits.max);
    if (limits.length != FieldLimits{}.length) text += fmt::format(", up to {} long", limits.length);
    return text;
}

std::vector<MessageField> message_fields(const MessageType& message) {
    std::vector<MessageField> rows;
    add_rows(rows, "", message.payload->single());
    if (rows.empty()) rows.push_back({.path = "", .values = values_of(*message.payload), .unit = "", .doc = ""});
    return rows;
}

}  // namespace nezumi

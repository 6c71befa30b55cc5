// Describes the values of fields in words.
#include "engine/records/record_shape.hpp"

#include <fmt/format.h>

#include <cctype>

#include "engine/records/write_record.hpp"

namespace nezumi {
namespace {

template <class Texts>
std::string list_of(const Texts& names, bool quoted, std::string_view separator) {
    std::string text;
    for (const auto& name : names) {
        if (!text.empty()) text += separator;
        text += quoted ? fmt::format("\"{}\"", name) : std::string(name);
    }
    return text;
}

bool is_switched(const Type& type) { return type.kind == Type::Kind::optional && is_record(*type.element); }

// The Lua type of a field, as editors know it.
std::string lua_type_of(const Type& type, const Rule& rule) {
    if (&type == &type_of<Point2D>() || &type == &type_of<Point3D>()) return "number[]";
    if (&type == &type_of<Pose2D>()) return "{ x?: number, y?: number, heading?: number }";
    switch (type.kind) {
        case Type::Kind::boolean: return rule.words[0].empty() ? "boolean" : list_of(rule.words, true, "|");
        case Type::Kind::float64: return "number";
        case Type::Kind::text: return rule.choices.empty() ? "string" : list_of(rule.choices, true, "|");
        case Type::Kind::enumeration: return list_of(type.choices, true, "|");
        case Type::Kind::any: return "ParameterValue";
        case Type::Kind::map: return "table<string, " + lua_type_of(*type.element, rule) + ">";
        case Type::Kind::structure: return class_of(type.name);
        case Type::Kind::optional: return (is_switched(type) ? "boolean|" : "") + lua_type_of(*type.element, rule);
        case Type::Kind::sequence:
            if (type.element->kind == Type::Kind::text) return "string|string[]";
            return "table<string, " + class_of(type.element->name) + "|false>";
        default: return "integer";
    }
}

std::string kinds_of(const Type& record, unsigned of) {
    std::string text;
    for (std::size_t i = 0; i < record.kinds.size(); ++i) {
        if ((of >> i & 1U) != 0) text += (text.empty() ? "" : ", ") + std::string(record.kinds[i]);
    }
    return text;
}

// The default of a field as text of a file; "" if there is none.
std::string fallback_of(const ValueView& value, const Rule& rule) {
    if (!rule.fallback.empty()) return std::string(rule.fallback);
    const bool is_place = value.type->kind == Type::Kind::structure && !is_record(*value.type);
    const bool is_shown = value.type->is_scalar()                ? value.type->kind != Type::Kind::nothing
                          : value.type->kind == Type::Kind::text ? !value.as<std::string>().empty()
                                                                 : is_place;
    return is_shown && !rule.required ? setting_text(value, rule) : "";
}

}  // namespace

std::string class_of(std::string_view record) {
    std::string name;
    bool is_first = true;
    for (const char c : record) {
        if (c != '_') name += is_first ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        is_first = c == '_';
    }
    return name.ends_with("Options") ? name : name + "Fields";
}

std::string words_of(const Type& type, const Rule& rule) {
    if (&type == &type_of<Point2D>()) return "{ x, y }";
    if (&type == &type_of<Point3D>()) return "{ x, y, z }";
    if (&type == &type_of<Pose2D>()) return "{ x =, y =, heading = }";
    switch (type.kind) {
        case Type::Kind::boolean: return rule.words[0].empty() ? "true or false" : list_of(rule.words, true, " or ");
        case Type::Kind::float64: return words_for(rule);
        case Type::Kind::text:
            return rule.choices.empty() ? "a string" : "one of " + list_of(rule.choices, false, ", ");
        case Type::Kind::enumeration: return "one of " + list_of(type.choices, false, ", ");
        case Type::Kind::map: return type.element->kind == Type::Kind::any ? "{ NAME = VALUE }" : "{ NAME = { ... } }";
        case Type::Kind::structure: return usage_of(type);
        case Type::Kind::optional: return (is_switched(type) ? "true, false or " : "") + words_of(*type.element, rule);
        case Type::Kind::sequence:
            return type.element->kind == Type::Kind::text ? "a name or a list of names" : "{ NAME = { ... } }";
        default: return fmt::format("a whole number from {} to {}", rule.min, rule.max);
    }
}

RecordShape shape_of(const Type& record) {
    RecordShape shape{record.name, record.doc, {}};
    const Value sample(record);
    for (const Type::Field& field : record.fields) {
        const Rule& rule = *field.rule;
        const bool is_extra = field.type->kind == Type::Kind::nothing;
        shape.rows.push_back({.name = field.name,
                              .type = is_extra ? field.lua_type : lua_type_of(*field.type, rule),
                              .values = is_extra ? "" : words_of(*field.type, rule),
                              .unit = field.unit,
                              .doc = field.doc,
                              .fallback = fallback_of(ValueView(sample).field(field), rule),
                              .kinds = kinds_of(record, rule.of),
                              .required = rule.required});
    }
    return shape;
}

}  // namespace nezumi

// One reader for all structures, by the table of their type.
#include "engine/records/read_record.hpp"

#include <fmt/format.h>

#include "engine/records/record_shape.hpp"

namespace nezumi {
namespace {

void read_setting(Fields& fields, const Type::Field& field, const ValuePlace& out);

void read_inner(Fields& fields, const Type::Field& field, const ValuePlace& out) {
    Fields inner = fields.inner(field.name);
    read_record(inner, out, {.is_whole = false});
    inner.done();
}

// Reads a text as its index in `choices`. Returns whether the field exists and is one of them.
template <class Texts>
bool read_choice(Fields& fields, const Type::Field& field, const Texts& choices, std::size_t& out) {
    return fields.choice(field.name, out, std::vector<std::string_view>(choices.begin(), choices.end()));
}

void read_text(Fields& fields, const Type::Field& field, std::string& out) {
    const Rule& rule = *field.rule;
    if (std::size_t choice = 0; !rule.choices.empty()) {
        if (read_choice(fields, field, rule.choices, choice)) out = rule.choices[choice];
        return;
    }
    if (!fields.text(field.name, out) || rule.adopt == nullptr) return;
    if (const std::string problem = rule.adopt(out); !problem.empty())
        fields.check().wrong(fields.path_of(field.name), problem);
}

void read_structure(Fields& fields, const Type::Field& field, const ValuePlace& out) {
    const Rule& rule = *field.rule;
    if (out.type == &type_of<Point2D>()) {
        auto& point = out.as<Point2D>();
        if (fields.point(field.name, point, rule.range))
            fields.check_lengths(field.name, rule, field.unit, {{point.x, point.y}});
    } else if (out.type == &type_of<Point3D>()) {
        auto& point = out.as<Point3D>();
        if (fields.point(field.name, point, rule.range, rule.level))
            fields.check_lengths(field.name, rule, field.unit, {{point.x, point.y, point.z}});
    } else if (out.type == &type_of<Pose2D>()) {
        fields.pose(field.name, out.as<Pose2D>());
    } else {
        read_inner(fields, field, out);
    }
}

// An optional structure: a table, true or false.
void read_switched(Fields& fields, const Type::Field& field, const ValuePlace& out) {
    const Value* value = fields.field(field.name);
    const bool* is_there = value != nullptr ? value->get_if<bool>() : nullptr;
    if (value == nullptr) return;
    if (value->get_if<FileTable>() != nullptr) {
        out.resize(1);
        read_inner(fields, field, {*out.type->element, out.first()});
    } else if (is_there != nullptr) {
        out.resize(*is_there ? 1 : 0);
    } else {
        fields.check().wrong(fields.path_of(field.name),
                             fmt::format("expected {}, got {}", words_of(*out.type, *field.rule), kind_of(*value)));
    }
}

void read_optional(Fields& fields, const Type::Field& field, const ValuePlace& out) {
    if (is_record(*out.type->element)) return read_switched(fields, field, out);
    if (!fields.has(field.name)) return;
    if (out.count() == 0) out.resize(1);
    read_setting(fields, field, {*out.type->element, out.first()});
}

// Reads parameter values by name, or parameter sets by name.
void read_map(Fields& fields, const Type::Field& field, const ValuePlace& out) {
    if (out.type->element->kind == Type::Kind::any) {
        fields.values(field.name, out.as<ParameterValues>());
        return;
    }
    Fields sets = fields.inner(field.name);
    for (const auto& [set, values] : sets.all())
        sets.values(set, *static_cast<ParameterValues*>(out.type->entries.add(out.at, set)));
    sets.done([](std::string_view) -> std::string { return ": expected NAME = { ... }"; });
}

void read_setting(Fields& fields, const Type::Field& field, const ValuePlace& out) {
    const Rule& rule = *field.rule;
    switch (out.type->kind) {
        case Type::Kind::boolean: {
            std::size_t word = 0;
            if (rule.words[0].empty()) {
                fields.boolean(field.name, out.as<bool>());
            } else if (read_choice(fields, field, rule.words, word)) {
                out.as<bool>() = word == 1;
            }
            return;
        }
        case Type::Kind::float64: fields.number(field.name, out.as<double>(), rule, field.unit); return;
        case Type::Kind::enumeration: {
            std::size_t choice = 0;
            if (read_choice(fields, field, out.type->choices, choice)) out.set_choice(choice);
            return;
        }
        case Type::Kind::text: return read_text(fields, field, out.as<std::string>());
        case Type::Kind::structure: return read_structure(fields, field, out);
        case Type::Kind::sequence: fields.names(field.name, out.as<std::vector<std::string>>()); return;
        case Type::Kind::optional: return read_optional(fields, field, out);
        case Type::Kind::map: return read_map(fields, field, out);
        default:
            visit_number(out, [&]<class T>(T& number) {
                std::int64_t whole = 0;
                if (fields.whole(field.name, whole, rule.min, rule.max)) number = static_cast<T>(whole);
            });
    }
}

}  // namespace

void read_record(Fields& fields, const ValuePlace& out, Reading reading) {
    for (const Type::Field& field : out.type->fields) {
        const Rule& rule = *field.rule;
        if (rule.of != 0 && reading.kind != 0 && (rule.of & reading.kind) == 0) continue;
        const Value* value = fields.field(field.name);
        if (field.type->kind == Type::Kind::nothing) continue;  // an `Extra`: read by special code
        if (value == nullptr && rule.required && reading.is_whole) {
            fields.require(field.name,
                           fmt::format("{}{}{}{}{}", words_of(*field.type, rule), field.unit.empty() ? "" : " in ",
                                       field.unit, field.doc.empty() ? "" : ": ", field.doc));
        }
        if (!rule.by_hand) read_setting(fields, field, out.field(field));
        if (field.type->kind == Type::Kind::enumeration && rule.selects)
            reading.kind = 1U << out.field(field).view().choice();
    }
}

}  // namespace nezumi

// Reads the table of a structure that describes itself, strictly and field by field.
#pragma once

#include <fmt/format.h>

#include "bindings/lua/files/file_fields.hpp"
#include "bindings/lua/files/record_shape.hpp"

namespace nezumi {

/// How a table is read.
struct Reading {
    unsigned kind = 0;     ///< of a structure that comes in kinds, as a bit; 0: the one that its own field selects
    bool is_whole = true;  ///< what is required must be there; else the table changes a structure that is whole
};

/// Reads every field that the description of `T` has and the table gives; the others keep their values. What is wrong
/// is said to the check of `fields`. Fields that are read by hand are only known from here on; `fields.done()` is left
/// to the caller.
template <Recorded T>
void read_record(Fields& fields, T& out, Reading reading = {});

namespace detail {

template <class T>
void read_setting(Fields& fields, std::string_view name, std::string_view unit, const Rule& rule, T& out) {
    if constexpr (std::is_same_v<T, bool>) {
        std::size_t word = out ? 1 : 0;
        if (rule.words[0].empty()) {
            fields.boolean(name, out);
        } else if (fields.choice(name, word, rule.words)) {
            out = word == 1;
        }
    } else if constexpr (std::is_same_v<T, double>) {
        fields.number(name, out, rule, unit);
    } else if constexpr (std::is_integral_v<T>) {
        std::int64_t whole = 0;
        if (fields.whole(name, whole, rule.min, rule.max)) out = static_cast<T>(whole);
    } else if constexpr (std::is_same_v<T, std::string>) {
        if (std::size_t choice = 0; !rule.choices.empty()) {
            if (fields.choice(name, choice, rule.choices)) out = rule.choices[choice];
            return;
        }
        if (!fields.text(name, out) || rule.adopt == nullptr) return;
        if (const std::string problem = rule.adopt(out); !problem.empty())
            fields.check().wrong(fields.path_of(name), problem);
    } else if constexpr (std::is_same_v<T, Point2D>) {
        if (fields.point(name, out, rule.range)) fields.check_lengths(name, rule, unit, {{out.x, out.y}});
    } else if constexpr (std::is_same_v<T, Point3D>) {
        if (fields.point(name, out, rule.range, rule.level))
            fields.check_lengths(name, rule, unit, {{out.x, out.y, out.z}});
    } else if constexpr (std::is_same_v<T, Pose2D>) {
        fields.pose(name, out);
    } else if constexpr (std::is_enum_v<T>) {
        std::size_t choice = 0;
        if (fields.choice(name, choice, Choices<T>::names)) out = static_cast<T>(choice);
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        fields.names(name, out);
    } else if constexpr (std::is_same_v<T, ParameterValues>) {
        fields.values(name, out);
    } else if constexpr (std::is_same_v<T, Sets>) {
        Fields sets = fields.inner(name);
        for (const auto& [set, values] : sets.all()) sets.values(set, out[set]);
        sets.done([](std::string_view) -> std::string { return ": expected NAME = { ... }"; });
    } else if constexpr (Recorded<T>) {
        Fields inner = fields.inner(name);
        read_record(inner, out, {.is_whole = false});
        inner.done();
    } else if constexpr (SwitchedRecord<T>) {
        const FileValue* value = fields.field(name);
        if (value != nullptr && value->table() != nullptr) {
            read_setting(fields, name, unit, rule, out.emplace());
        } else if (value != nullptr && !std::holds_alternative<bool>(value->data)) {
            fields.check().wrong(fields.path_of(name),
                                 fmt::format("expected {}, got {}", values_of<T>(rule), kind_of(*value)));
        } else if (bool is_there = false; fields.boolean(name, is_there)) {
            out.reset();
            if (is_there) out.emplace();
        }
    } else if constexpr (IsOptional<T>::value) {
        if (!fields.has(name)) return;
        typename T::value_type read = out.value_or(typename T::value_type{});
        read_setting(fields, name, unit, rule, read);
        out = read;
    }
}

}  // namespace detail

template <Recorded T>
void read_record(Fields& fields, T& out, Reading reading) {
    for_each_setting<T>([&](const auto& field) {
        const Rule& rule = field.rule;
        if (rule.of != 0 && reading.kind != 0 && (rule.of & reading.kind) == 0) return;
        const FileValue* value = fields.field(field.name);
        if constexpr (requires { field.member; }) {
            auto& member = out.*(field.member);
            using Member = std::remove_cvref_t<decltype(member)>;
            if (value == nullptr && rule.required && reading.is_whole) {
                fields.require(field.name, fmt::format("{}{}{}{}{}", detail::values_of<Member>(rule),
                                                       field.unit.empty() ? "" : " in ", field.unit,
                                                       field.doc.empty() ? "" : ": ", field.doc));
            }
            if (!rule.by_hand) detail::read_setting(fields, field.name, field.unit, rule, member);
            if constexpr (std::is_enum_v<Member>) {
                if (rule.selects) reading.kind = 1U << static_cast<unsigned>(member);
            }
        }
    });
}

}  // namespace nezumi

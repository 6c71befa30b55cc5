// The structures that a person writes as tables, as data: what editors' annotations and the tables of the documentation
// are made from.
#pragma once

#include <concepts>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bindings/lua/files/lua_value_text.hpp"
#include "engine/components/parameter.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/setting.hpp"
#include "engine/ports/usage.hpp"

namespace nezumi {

/// One field as a person sees it.
struct FieldRow {
    std::string name;
    std::string type;    ///< Lua's, as editors know it
    std::string values;  ///< in words
    std::string unit;    ///< "" for none
    std::string doc;
    std::string fallback;  ///< what holds without it; "" for nothing
    std::string kinds;     ///< those of the structure that have it; "" for all
    bool required = false;
};

/// One structure.
struct RecordShape {
    std::string name;
    std::string doc;
    std::vector<FieldRow> rows;
};

/// "robot_model": "RobotModelFields", "parameter_options": "ParameterOptions".
std::string class_of(std::string_view record);

namespace detail {

/// A structure that is there or not: a table with its fields, true for all as it is by itself, or false.
template <class T>
concept SwitchedRecord = IsOptional<T>::value && Recorded<typename T::value_type>;

using Sets = std::map<std::string, ParameterValues, std::less<>>;

std::string list_of(std::span<const std::string_view> names, bool quoted, std::string_view separator);

/// What belongs into a field that a `T` holds, in words: "a positive number", "{ x, y, z }", "one of box, cylinder".
template <class T>
std::string values_of(const Rule& rule) {
    if constexpr (std::is_same_v<T, bool>) {
        return rule.words[0].empty() ? "true or false" : list_of(rule.words, true, " or ");
    } else if constexpr (std::is_same_v<T, double>) {
        return std::string(words_for(rule.range));
    } else if constexpr (std::is_integral_v<T>) {
        return fmt::format("a whole number from {} to {}", rule.min, rule.max);
    } else if constexpr (std::is_same_v<T, std::string>) {
        return rule.choices.empty() ? "a text" : "one of " + list_of(rule.choices, false, ", ");
    } else if constexpr (std::is_same_v<T, Point2D>) {
        return "{ x, y }";
    } else if constexpr (std::is_same_v<T, Point3D>) {
        return "{ x, y, z }";
    } else if constexpr (std::is_same_v<T, Pose2D>) {
        return "{ x =, y =, heading = }";
    } else if constexpr (std::is_enum_v<T>) {
        return "one of " + list_of(Choices<T>::names, false, ", ");
    } else if constexpr (std::is_same_v<T, ParameterValues>) {
        return "{ NAME = VALUE }";
    } else if constexpr (Recorded<T>) {
        return usage_of<T>();
    } else if constexpr (SwitchedRecord<T>) {
        return "true, false or " + values_of<typename T::value_type>(rule);
    } else if constexpr (IsOptional<T>::value) {
        return values_of<typename T::value_type>(rule);
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        return "a name or a list of names";
    } else {
        return "{ NAME = { ... } }";
    }
}

/// The same as Lua's type.
template <class T>
std::string lua_type_of(const Rule& rule) {
    if constexpr (std::is_same_v<T, bool>) {
        return rule.words[0].empty() ? "boolean" : list_of(rule.words, true, "|");
    } else if constexpr (std::is_same_v<T, double>) {
        return "number";
    } else if constexpr (std::is_integral_v<T>) {
        return "integer";
    } else if constexpr (std::is_same_v<T, std::string>) {
        return rule.choices.empty() ? "string" : list_of(rule.choices, true, "|");
    } else if constexpr (std::is_same_v<T, Point2D> || std::is_same_v<T, Point3D>) {
        return "number[]";
    } else if constexpr (std::is_same_v<T, Pose2D>) {
        return "{ x?: number, y?: number, heading?: number }";
    } else if constexpr (std::is_enum_v<T>) {
        return list_of(Choices<T>::names, true, "|");
    } else if constexpr (std::is_same_v<T, ParameterValues>) {
        return "table<string, ParameterValue>";
    } else if constexpr (std::is_same_v<T, Sets>) {
        return "table<string, table<string, ParameterValue>>";
    } else if constexpr (Recorded<T>) {
        return class_of(Describe<T>::name);
    } else if constexpr (SwitchedRecord<T>) {
        return "boolean|" + lua_type_of<typename T::value_type>(rule);
    } else if constexpr (IsOptional<T>::value) {
        return lua_type_of<typename T::value_type>(rule);
    } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
        return "string|string[]";
    } else {
        static_assert(IsVector<T>::value);
        return "table<string, " + class_of(Describe<typename T::value_type>::name) + "|false>";
    }
}

template <class T>
std::string kinds_of(unsigned of) {
    std::string text;
    if constexpr (requires { Describe<T>::kinds; }) {
        for (std::size_t i = 0; i < Describe<T>::kinds.size(); ++i) {
            if ((of >> i & 1U) != 0) text += (text.empty() ? "" : ", ") + std::string(Describe<T>::kinds[i]);
        }
    }
    return text;
}

/// What a field that was not given holds, as a file would say it; "" for nothing.
template <class T>
std::string fallback_of(const T& value, const Rule& rule) {
    if (!rule.fallback.empty()) return std::string(rule.fallback);
    if (rule.required) return "";
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Point2D> ||
                  std::is_same_v<T, Point3D> || std::is_same_v<T, Pose2D>) {
        return lua_text(value, rule);
    } else if constexpr (std::is_same_v<T, std::string>) {
        return value.empty() ? "" : lua_text(value, rule);
    } else {
        return "";
    }
}

}  // namespace detail

/// The description of `T` as data.
template <Recorded T>
RecordShape shape_of_record() {
    RecordShape shape{std::string(Describe<T>::name), std::string(Describe<T>::doc), {}};
    const T sample{};
    for_each_setting<T>([&](const auto& field) {
        FieldRow row;
        row.name = field.name;
        row.unit = field.unit;
        row.doc = field.doc;
        row.required = field.rule.required;
        row.kinds = detail::kinds_of<T>(field.rule.of);
        if constexpr (requires { field.member; }) {
            using Member = std::remove_cvref_t<decltype(sample.*(field.member))>;
            row.type = detail::lua_type_of<Member>(field.rule);
            row.values = detail::values_of<Member>(field.rule);
            row.fallback = detail::fallback_of(sample.*(field.member), field.rule);
        } else {
            row.type = field.type;
            row.fallback = field.rule.fallback;
        }
        shape.rows.push_back(std::move(row));
    });
    return shape;
}

}  // namespace nezumi

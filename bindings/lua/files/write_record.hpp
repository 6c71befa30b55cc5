// Writes a structure that describes itself as the table that a person would write.
#pragma once

#include <string>

#include "bindings/lua/files/lua_value_text.hpp"
#include "bindings/lua/files/record_shape.hpp"

namespace nezumi {

/// The fields in which `value` differs from `from`, and those that are required: what a reader who begins with `from`
/// needs. Fields that are read by hand are left out. "{}" when there is nothing to say.
template <Recorded T>
std::string write_record(const T& value, const T& from = {});

namespace detail {

template <class T>
std::string write_setting(const T& value, const T& from, const Rule& rule) {
    if constexpr (Recorded<T>) {
        return write_record(value, from);
    } else if constexpr (std::is_same_v<T, ParameterValues>) {
        std::string text;
        for (const auto& [name, each] : value)
            text += (text.empty() ? "{ " : ", ") + lua_key(name) + " = " + to_text(each);
        return text.empty() ? "{}" : text + " }";
    } else if constexpr (std::is_same_v<T, Sets>) {
        std::string text;
        for (const auto& [name, each] : value)
            text += (text.empty() ? "{ " : ", ") + lua_key(name) + " = " + write_setting(each, {}, rule);
        return text.empty() ? "{}" : text + " }";
    } else if constexpr (SwitchedRecord<T>) {
        const std::string text = value ? write_record(*value) : "false";
        return text == "{}" ? "true" : text;
    } else if constexpr (IsOptional<T>::value) {
        return write_setting(value.value(), from.value_or(typename T::value_type{}), rule);
    } else {
        return lua_text(value, rule);
    }
}

}  // namespace detail

template <Recorded T>
std::string write_record(const T& value, const T& from) {
    std::string text;
    for_each_setting<T>([&](const auto& field) {
        if constexpr (requires { field.member; }) {
            using Member = std::remove_cvref_t<decltype(value.*(field.member))>;
            if constexpr (!detail::IsVector<Member>::value) {
                const auto& member = value.*(field.member);
                const auto& before = from.*(field.member);
                if (field.rule.by_hand || (!field.rule.required && member == before)) return;
                text += (text.empty() ? "{ " : ", ") + std::string(field.name) + " = " +
                        detail::write_setting(member, before, field.rule);
            }
        }
    });
    return text.empty() ? "{}" : text + " }";
}

}  // namespace nezumi

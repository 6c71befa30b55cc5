// Values as a file writes them: each reads back as the same value.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <type_traits>

#include "engine/base/lua_text.hpp"
#include "engine/components/parameter.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/setting.hpp"

namespace nezumi {

/// A name as the key of a table: `speed`, `["two words"]`.
std::string lua_key(const std::string& name);

namespace detail {
std::string lua_list(std::span<const double> numbers);
}  // namespace detail

/// A field's value.
template <class T>
std::string lua_text(const T& value, const Rule& rule = {}) {
    if constexpr (std::is_same_v<T, bool>) {
        return rule.words[0].empty() ? (value ? "true" : "false") : lua_quoted(rule.words[value ? 1 : 0]);
    } else if constexpr (std::is_same_v<T, double>) {
        return lua_number(value);
    } else if constexpr (std::is_integral_v<T>) {
        return std::to_string(value);
    } else if constexpr (std::is_enum_v<T>) {
        return lua_quoted(Choices<T>::names[static_cast<std::size_t>(value)]);
    } else if constexpr (std::is_same_v<T, Point2D>) {
        return detail::lua_list({{value.x, value.y}});
    } else if constexpr (std::is_same_v<T, Point3D>) {
        return detail::lua_list({{value.x, value.y, value.z}});
    } else if constexpr (std::is_same_v<T, Pose2D>) {
        return fmt::format("{{ x = {}, y = {}, heading = {} }}", lua_number(value.position.x),
                           lua_number(value.position.y), lua_number(value.heading));
    } else {
        return lua_quoted(value);
    }
}

}  // namespace nezumi

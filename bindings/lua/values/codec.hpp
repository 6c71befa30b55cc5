// Converts payloads and parameters between C++ and Lua, in both directions, by the descriptions of their types.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <lua.hpp>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"
#include "engine/ports/messages.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {

// Two rules hold in this file. Reading raises no Lua error and runs no metamethod, because it reads tables only with
// raw access, also those behind read-only tables. So C++ objects may exist while it runs. Pushing may raise a Lua error
// (memory), which skips destructors: push within a protected call that contains no objects with destructors.

/// Why a Lua value does not fit.
struct Mismatch {
    std::string path;      ///< "" for the value itself, "position.x", "[3]", "ranges[3]"
    std::string text;      ///< "expected a number, got string"
    bool unknown = false;  ///< there is no field `path`; `text` is a hint
};

/// "field 'position.x' expected a number, got string", "element 3 expected ...", "unknown field 'vz' (did you mean
/// 'vx'?)".
std::string describe(const Mismatch& why);

/// Slots of Lua's stack that are enough to push or to read any payload: the deepest one has `most_message_depth`
/// levels.
inline constexpr int codec_stack = 40;
/// Slots for a payload of this type. Every C function has `LUA_MINSTACK` slots without `lua_checkstack`.
template <class T>
inline constexpr int codec_stack_of = std::is_same_v<T, Value> ? codec_stack : 4;
template <Sequence T>
inline constexpr int codec_stack_of<T> = 3 + codec_stack_of<typename T::value_type>;
template <Described T>
inline constexpr int codec_stack_of<T> = Describe<T>::fields.apply([](const auto&... field) {
    return 3 + std::max({codec_stack_of<std::remove_cvref_t<decltype(std::declval<T>().*field.member)>>...});
});

/// Pushes a new copy of a message or a parameter, which the script may change. Arrays become plain tables.
void push_payload(lua_State* L, const ValueView& value);
/// Sets the fields of the table on top of the stack to those of a structure.
void fill_fields(lua_State* L, const ValueView& value);
/// Reads the value at `index` as a payload of this message type, or returns the error (the text of
/// `describe(Mismatch)`).
Expected<Value> read_payload(lua_State* L, int index, const MessageType* type);

/// Reads the value at `index` (absolute) into the payload of a message type from a file, in one pass. Returns false if
/// it does not fit; then `read_payload` gives the error, and `out` is invalid.
bool read_described(lua_State* L, int index, const ValuePlace& out);
/// Reads the values from `first` on into these fields of a structure; nil leaves out a field. The fields that are left
/// out get their default. Returns false if a value does not fit; then `out` is invalid.
bool read_fields(lua_State* L, int first, std::span<const Type::Field* const> fields, const ValuePlace& out);

/// The boolean, number or text at `index`; nothing for any other value.
Value read_single(lua_State* L, int index);
/// Reads the value at `index` as a parameter's value, or returns the error.
Expected<Value> read_parameter(lua_State* L, int index);

/// The number of elements, if the keys of the table at `index` are exactly 1..n. Otherwise -1, and the reason in `why`
/// unless that is null.
std::ptrdiff_t read_array_size(lua_State* L, int index, Mismatch* why);

/// The table at an absolute index. If it is read-only, the table behind it instead, which is on the stack while this
/// object exists.
class UnlockedTable {
public:
    UnlockedTable(lua_State* L, int index)
        : L_(L), pushed_(push_behind_lock(L, index)), index_(pushed_ ? lua_gettop(L) : index) {}
    ~UnlockedTable() {
        if (pushed_) lua_pop(L_, 1);
    }
    UnlockedTable(const UnlockedTable&) = delete;
    UnlockedTable& operator=(const UnlockedTable&) = delete;

    int index() const { return index_; }

private:
    lua_State* L_;
    bool pushed_;
    int index_;
};

namespace detail {

// After an error, each of these functions writes it to `why` (unless this is null) and returns false.
bool read_boolean(lua_State* L, int index, bool& out, Mismatch* why);
bool read_integer(lua_State* L, int index, std::int64_t min, std::int64_t max, std::int64_t& out, Mismatch* why);
bool read_number(lua_State* L, int index, double max, double& out, Mismatch* why, Numbers numbers = Numbers::finite);
bool read_text(lua_State* L, int index, std::string_view& out, Mismatch* why);
// Like `push_value` and `read_value`, but by the description of the type at run time (`Type`). Fields are read in the
// order of the description, so errors do not depend on the order of a table's keys. Missing fields keep their value in
// `out`.
void push_any(lua_State* L, const ValueView& value);
bool read_any(lua_State* L, int index, const ValuePlace& out, Mismatch* why, Numbers numbers = Numbers::finite);
// Finds a raw field without making a Lua string, which could raise an error. Pushes its value; if there is none, pushes
// nothing and returns false.
bool push_raw_field(lua_State* L, int index, std::string_view name);
// The string below the top of the stack: the key during lua_next.
std::string_view key_text(lua_State* L);

}  // namespace detail

template <class T>
void push_value(lua_State* L, const T& value);

/// Sets the fields or elements of the table on top of the stack.
template <class T>
void fill_table(lua_State* L, const T& value) {
    if constexpr (std::is_same_v<T, Value>) {
        fill_fields(L, value);
    } else if constexpr (Described<T>) {
        for_each_field(value, [L](const auto& field, const auto& member) {
            lua_pushlstring(L, field.name.data(), field.name.size());
            push_value(L, member);
            lua_rawset(L, -3);
        });
    } else {
        for (std::size_t i = 0; i < value.size(); ++i) {
            push_value<typename T::value_type>(L, value[i]);
            lua_rawseti(L, -2, static_cast<lua_Integer>(i + 1));
        }
    }
}

template <class T>
void push_value(lua_State* L, const T& value) {
    if constexpr (Described<T>) {
        lua_createtable(L, 0, static_cast<int>(Describe<T>::fields.count));
        fill_table(L, value);
    } else if constexpr (Sequence<T>) {
        lua_createtable(L, static_cast<int>(value.size()), 0);
        fill_table(L, value);
    } else if constexpr (std::is_same_v<T, bool>) {
        lua_pushboolean(L, value ? 1 : 0);
    } else if constexpr (std::is_integral_v<T>) {
        lua_pushinteger(L, static_cast<lua_Integer>(value));
    } else if constexpr (std::is_floating_point_v<T>) {
        lua_pushnumber(L, static_cast<lua_Number>(value));
    } else {
        static_assert(std::is_same_v<T, std::string> || std::is_same_v<T, Octets>);
        lua_pushlstring(L, reinterpret_cast<const char*>(value.data()), value.size());
    }
}

/// Reads the value at `index` (absolute) into `out`. Returns false if the value does not fit; then `out` is invalid.
template <class T>
bool read_value(lua_State* L, int index, T& out, Numbers numbers = Numbers::finite);

namespace detail {

// Reads in one pass over the keys, in any order: no error is described, so it does not matter which one is found first.
template <class T>
bool read_fields(lua_State* L, int index, T& out) {
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
        bool fits = false;
        if (lua_type(L, -2) == LUA_TSTRING) {
            const std::string_view key = key_text(L);
            for_each_field(out, [&](const auto& field, auto& member) {
                if (!fits && field.name == key) fits = read_value(L, lua_gettop(L), member, numbers_of(field));
            });
        }
        if (!fits) {
            lua_pop(L, 2);
            return false;
        }
        lua_pop(L, 1);
    }
    return true;
}

template <class T>
bool read_sequence(lua_State* L, int index, T& out, Numbers numbers) {
    out.clear();
    // lua_next visits a table's array part in order. If the keys are not in order, all elements are read again by
    // index, which is slower.
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
        typename T::value_type element{};
        const bool in_order = lua_isinteger(L, -2) && lua_tointeger(L, -2) == static_cast<lua_Integer>(out.size() + 1);
        if (!in_order || !read_value(L, lua_gettop(L), element, numbers)) {
            lua_pop(L, 2);
            const std::ptrdiff_t size = read_array_size(L, index, nullptr);
            out.clear();
            for (std::ptrdiff_t i = 1; i <= size; ++i) {
                lua_rawgeti(L, index, i);
                typename T::value_type each{};
                const bool fits = read_value(L, lua_gettop(L), each, numbers);
                lua_pop(L, 1);
                if (!fits) return false;
                out.push_back(std::move(each));
            }
            return size >= 0;
        }
        out.push_back(std::move(element));
        lua_pop(L, 1);
    }
    return true;
}

}  // namespace detail

template <class T>
bool read_value(lua_State* L, int index, T& out, Numbers numbers) {
    if constexpr (Described<T>) {
        if (lua_type(L, index) != LUA_TTABLE) return false;
        out = T{};
        return detail::read_fields(L, UnlockedTable(L, index).index(), out);
    } else if constexpr (Sequence<T>) {
        if (lua_type(L, index) != LUA_TTABLE) return false;
        return detail::read_sequence(L, UnlockedTable(L, index).index(), out, numbers);
    } else if constexpr (std::is_same_v<T, bool>) {
        return detail::read_boolean(L, index, out, nullptr);
    } else if constexpr (std::is_integral_v<T>) {
        std::int64_t whole = 0;
        constexpr auto min = std::numeric_limits<T>::min(), max = std::numeric_limits<T>::max();
        if (!detail::read_integer(L, index, min, max, whole, nullptr)) return false;
        out = static_cast<T>(whole);
        return true;
    } else if constexpr (std::is_floating_point_v<T>) {
        double number = 0;
        constexpr auto max = static_cast<double>(std::numeric_limits<T>::max());
        if (!detail::read_number(L, index, max, number, nullptr, numbers)) return false;
        out = static_cast<T>(number);
        return true;
    } else {
        static_assert(std::is_same_v<T, std::string> || std::is_same_v<T, Octets>);
        std::string_view text;
        if (!detail::read_text(L, index, text, nullptr)) return false;
        out.assign(text.begin(), text.end());
        return true;
    }
}

/// Reads a value; stores the error in `why`.
template <class T>
bool read_value(lua_State* L, int index, T& out, Mismatch* why) {
    if (read_value(L, index, out)) return true;
    out = T{};
    return detail::read_any(L, index, out, why);
}

}  // namespace nezumi

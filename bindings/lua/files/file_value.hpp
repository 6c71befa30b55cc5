// Data that a Lua file handed to one of our words: a copy, so that what the file does with its tables later changes
// nothing.
#pragma once

#include <cstddef>
#include <lua.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

struct FileField;

/// A table: elements 1..n, and everything else by its key as a message shows it ("x", "[7]", "[true]"), in ascending
/// order.
struct FileTable {
    std::vector<Value> elements;
    std::vector<FileField> fields;

    /// nullptr when there is no such field.
    const Value* find(std::string_view name) const;
};

/// A field of a table.
struct FileField {
    std::string name;
    Value value;
};

/// What one of our words returned for a thing of the arena: its number.
struct FileThing {
    std::size_t index = 0;
};

/// A function. It stays in Lua; what it is good for is found there by its path.
struct FileFunction {};

/// Anything else; `kind` is Lua's name of its type.
struct FileOther {
    std::string kind;
};

template <class T>
requires is_alternative<T, std::variant<FileTable, FileField, FileThing, FileFunction, FileOther>>
inline constexpr bool described_by_names<T> = true;

/// The value at `index`, nothing for nil, raw: no metamethod runs, no Lua error is raised. Tables within tables are
/// followed 32 levels deep (so a table within itself is an error), and a value may have 1 000 000 parts.
Expected<Value> read_file_value(lua_State* lua, int index);

/// Puts a thing of the arena on the stack; `read_file_value` finds its number again. Raises no Lua error.
void push_file_thing(lua_State* lua, FileThing thing);

/// Lua's name of the value's type: "number", "table", "nil", ...
std::string kind_of(const Value& value);

/// As a file writes it: `{ noise = 0.05, at = { 0.1, 0.0 } }`. What has no text (a function) is `nil`.
std::string to_lua(const Value& value);

/// A number, whole or not; nothing for anything else.
std::optional<double> number_of(const Value& value);

/// As a parameter's value: a truth value, a number, a text, or an array of one of them. The error says what it is
/// instead.
Expected<Value> to_parameter(const Value& value);

}  // namespace nezumi

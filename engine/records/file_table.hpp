// Data that a Lua file passes to a function such as `robot`. It is a copy, so later changes of the file's tables have
// no effect.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/value.hpp"

namespace nezumi {

struct FileField;

/// A table: elements 1..n, and all other entries by their keys as messages show them ("x", "[7]", "[true]"), in
/// ascending order.
struct FileTable {
    std::vector<Value> elements;
    std::vector<FileField> fields;

    /// nullptr if there is no such field.
    const Value* find(std::string_view name) const;
};

/// A field of a table.
struct FileField {
    std::string name;
    Value value;
};

/// An object of the arena, which a function such as `box` has made: its index.
struct FileThing {
    std::size_t index = 0;
};

/// A function. It stays in Lua, and is found there by the path of its field.
struct FileFunction {};

/// Any other value; `kind` is the name of its Lua type.
struct FileOther {
    std::string kind;
};

template <class T>
requires is_alternative<T, std::variant<FileTable, FileField, FileThing, FileFunction, FileOther>>
inline constexpr bool described_by_names<T> = true;

/// The name of the value's Lua type: "number", "table", "nil", ...
std::string kind_of(const Value& value);

/// The value in Lua syntax: `{ noise = 0.05, at = { 0.1, 0.0 } }`. A value that can't be written (a function) is `nil`.
std::string to_lua(const Value& value);

/// A number, whole or not; nothing for anything else.
std::optional<double> number_of(const Value& value);

/// The value as a parameter: a boolean, a number, a text, or an array of one of these. The error names the type
/// of the value.
Expected<Value> to_parameter(const Value& value);

}  // namespace nezumi

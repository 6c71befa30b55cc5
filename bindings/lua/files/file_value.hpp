// Data that a Lua file handed to one of our words: a copy, so that what the file does with its tables later changes
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi {

struct FileValue;
struct FileField;

/// A table: elements 1..n, and everything else by its key as a message shows it ("x", "[7]", "[true]"), in ascending
/// order.
struct FileTable {
    std::vector<FileValue> elements;
    std::vector<FileField> fields;

    /// nullptr when there is no such field.
    const FileValue* find(std::string_view name) const;
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

struct FileValue {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, FileTable, FileThing, FileFunction, FileOther>
        data;

    bool is_nil() const { return std::holds_alternative<std::monostate>(data); }
    const FileTable* table() const { return std::get_if<FileTable>(&data); }
    const std::string* text() const { return std::get_if<std::string>(&data); }
};

/// A field of a table.
struct FileField {
    std::string name;
    FileValue value;
};

/// The value at `index`, raw: no metamethod runs, no Lua error is raised. Tables within tables are followed 32 levels
/// deep (so a table within itself is an error), and a value may have 1 000 000 parts.
Expected<FileValue> read_file_value(lua_State* lua, int index);

/// Puts a thing of the arena on the stack; `read_file_value` finds its number again. Raises no Lua error.
void push_file_thing(lua_State* lua, FileThing thing);

/// Lua's name of the value's type: "number", "table", "nil", ...
std::string kind_of(const FileValue& value);

/// As a file writes it: `{ noise = 0.05, at = { 0.1, 0.0 } }`. What has no text (a function) is `nil`.
std::string to_lua(const FileValue& value);

/// As a parameter's value: a truth value, a number, a text, or an array of one of them. The error says what it is
/// instead.
Expected<ParameterValue> to_parameter(const FileValue& value);

}  // namespace nezumi

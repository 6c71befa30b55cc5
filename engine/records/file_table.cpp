// Tables of a file as values.
#include "engine/records/file_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/base/lua_text.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

// All elements as T, or nothing if one is not a T.
template <class T>
std::optional<std::vector<T>> all_as(const FileTable& table) {
    std::vector<T> values;
    for (const Value& element : table.elements) {
        const T* value = element.get_if<T>();
        if (value == nullptr) return std::nullopt;
        values.push_back(*value);
    }
    return values;
}

Expected<Value> to_array(const FileTable& table) {
    if (!table.fields.empty())
        return failure(fmt::format("expected an array, got a table with a field '{}'", table.fields.front().name));
    if (auto values = all_as<std::int64_t>(table)) return std::move(*values);
    if (auto values = all_as<bool>(table)) return std::move(*values);
    if (auto values = all_as<std::string>(table)) return std::move(*values);
    std::vector<double> numbers;
    for (const Value& element : table.elements) {
        const auto number = number_of(element);
        if (!number) return failure("expected an array of numbers, of booleans or of strings");
        if (!std::isfinite(*number)) return failure(fmt::format("expected finite numbers, got {}", *number));
        numbers.push_back(*number);
    }
    return numbers;
}

}  // namespace

const Value* FileTable::find(std::string_view name) const {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.name == name; });
    return found == fields.end() ? nullptr : &found->value;
}

std::string kind_of(const Value& value) {
    if (const auto* other = value.get_if<FileOther>()) return other->kind;
    if (value.is<FileTable>()) return "table";
    if (value.is<FileThing>()) return "thing of the arena";
    if (value.is<FileFunction>()) return "function";
    if (value.is_nothing()) return "nil";
    return value.is<std::string>() ? "string" : value.is<bool>() ? "boolean" : "number";
}

std::string to_lua(const Value& value) {
    const auto* table = value.get_if<FileTable>();
    if (table == nullptr) return value.type().is_single() ? lua_text(value) : "nil";
    std::string text;
    for (const Value& element : table->elements) text += (text.empty() ? "{ " : ", ") + to_lua(element);
    for (const FileField& field : table->fields)
        text += (text.empty() ? "{ " : ", ") + lua_key(field.name) + " = " + to_lua(field.value);
    return text.empty() ? "{}" : text + " }";
}

std::optional<double> number_of(const Value& value) {
    if (const auto* whole = value.get_if<std::int64_t>()) return static_cast<double>(*whole);
    if (const auto* number = value.get_if<double>()) return *number;
    return std::nullopt;
}

Expected<Value> to_parameter(const Value& value) {
    if (const auto* table = value.get_if<FileTable>()) return to_array(*table);
    if (const auto* number = value.get_if<double>(); number != nullptr && !std::isfinite(*number))
        return failure(fmt::format("expected a finite number, got {}", *number));
    if (value.type().is_single() && !value.is_nothing()) return value;
    return failure(fmt::format("expected a number, a boolean, a string or an array of them, got {}", kind_of(value)));
}

}  // namespace nezumi

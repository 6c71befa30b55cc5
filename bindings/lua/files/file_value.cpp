// Copies values out of Lua without raising Lua errors.
#include "bindings/lua/files/file_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/base/lua_text.hpp"
#include "engine/values/value_text.hpp"

namespace nezumi {
namespace {

constexpr int deepest = 32;
constexpr std::size_t most_parts = 1'000'000;

class ValueReader {
public:
    explicit ValueReader(lua_State* lua) : lua_(lua) {}

    Expected<Value> read(int index, int depth) {
        if (depth > deepest) return failure("tables are nested too deeply, or a table is within itself");
        if (++parts_ > most_parts) return failure(fmt::format("has more than {} parts", most_parts));
        if (lua_checkstack(lua_, 4) == 0) return failure("tables are nested too deeply");
        switch (lua_type(lua_, index)) {
            case LUA_TNONE:
            case LUA_TNIL: return Value{};
            case LUA_TTABLE: return read_table(index, depth);
            case LUA_TLIGHTUSERDATA: {
                const auto number = reinterpret_cast<std::uintptr_t>(lua_touserdata(lua_, index));
                return Value{FileThing{static_cast<std::size_t>(number) - 1}};
            }
            case LUA_TFUNCTION: return Value{FileFunction{}};
            default:
                if (Value single = read_single(lua_, index); !single.is_nothing()) return single;
                return Value{FileOther{lua_typename(lua_, lua_type(lua_, index))}};
        }
    }

private:
    // Only for strings, because the conversion of a number could raise an error.
    std::string text_at(int index) {
        std::size_t size = 0;
        const char* text = lua_tolstring(lua_, index, &size);
        return {text, size};
    }

    std::string key_at(int index) {
        switch (lua_type(lua_, index)) {
            case LUA_TSTRING: return text_at(index);
            case LUA_TNUMBER:
                if (lua_isinteger(lua_, index) != 0) return fmt::format("[{}]", lua_tointeger(lua_, index));
                return fmt::format("[{}]", lua_tonumber(lua_, index));
            case LUA_TBOOLEAN: return lua_toboolean(lua_, index) != 0 ? "[true]" : "[false]";
            default: return fmt::format("[a {}]", lua_typename(lua_, lua_type(lua_, index)));
        }
    }

    Expected<Value> read_table(int index, int depth) {
        index = lua_absindex(lua_, index);
        if (push_behind_lock(lua_, index)) {
            auto behind = read_table(-1, depth);
            lua_pop(lua_, 1);
            return behind;
        }
        FileTable table;
        for (lua_Integer i = 1;; ++i) {
            const bool nothing = lua_rawgeti(lua_, index, i) == LUA_TNIL;
            if (nothing) {
                lua_pop(lua_, 1);
                break;
            }
            auto element = read(-1, depth + 1);
            lua_pop(lua_, 1);
            if (!element) return element;
            table.elements.push_back(std::move(*element));
        }
        const auto count = static_cast<lua_Integer>(table.elements.size());
        lua_pushnil(lua_);
        while (lua_next(lua_, index) != 0) {
            const bool is_element =
                lua_isinteger(lua_, -2) != 0 && lua_tointeger(lua_, -2) >= 1 && lua_tointeger(lua_, -2) <= count;
            if (!is_element) {
                std::string key = key_at(-2);
                auto value = read(-1, depth + 1);
                if (!value) {
                    lua_pop(lua_, 2);
                    return value;
                }
                table.fields.push_back({std::move(key), std::move(*value)});
            }
            lua_pop(lua_, 1);
        }
        std::stable_sort(table.fields.begin(), table.fields.end(),
                         [](const auto& a, const auto& b) { return a.name < b.name; });
        return Value{std::move(table)};
    }

    lua_State* lua_;
    std::size_t parts_ = 0;
};

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
        if (!number) return failure("expected an array of numbers, of truth values or of texts");
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

Expected<Value> read_file_value(lua_State* lua, int index) { return ValueReader(lua).read(index, 0); }

void push_file_thing(lua_State* lua, FileThing thing) {
    lua_pushlightuserdata(lua, reinterpret_cast<void*>(static_cast<std::uintptr_t>(thing.index + 1)));
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
    return failure(fmt::format("expected a number, a truth value, a text or an array of them, got {}", kind_of(value)));
}

}  // namespace nezumi

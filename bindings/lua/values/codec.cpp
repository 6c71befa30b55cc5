// The parts of the codec that do not depend on the payload's type, and payloads whose type is known only at run time.
#include "bindings/lua/values/codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "bindings/lua/sandbox/text.hpp"
#include "engine/base/list.hpp"
#include "engine/values/limits.hpp"

namespace nezumi {
namespace {

bool refuse(Mismatch* why, std::string text) {
    if (why != nullptr) *why = {.path = "", .text = std::move(text)};
    return false;
}

bool refuse_type(lua_State* L, int index, std::string_view expected, Mismatch* why) {
    return why != nullptr && refuse(why, fmt::format("expected {}, got {}", expected, luaL_typename(L, index)));
}

// Converts a double to a whole number if possible.
std::optional<std::int64_t> whole_number(double value) {
    constexpr double limit = 9223372036854775808.0;  // 2^63
    if (!(value >= -limit && value < limit) || value != std::floor(value)) return std::nullopt;
    return static_cast<std::int64_t>(value);
}

// A key in messages: "[3]", "[true]", "[table]".
std::string key_name(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TNUMBER:
            return lua_isinteger(L, index) ? fmt::format("[{}]", lua_tointeger(L, index))
                                           : fmt::format("[{}]", number_at(L, index));
        case LUA_TBOOLEAN: return lua_toboolean(L, index) != 0 ? "[true]" : "[false]";
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* text = lua_tolstring(L, index, &size);
            return {text, size};
        }
        default: return fmt::format("[{}]", luaL_typename(L, index));
    }
}

// A hint after the message about an unknown field: all names that exist.
std::string list_of(const std::vector<std::string_view>& names) {
    return fmt::format(" (its fields are {})", fmt::join(names, ", "));
}

}  // namespace

std::string describe(const Mismatch& why) {
    if (why.unknown) return fmt::format("unknown field '{}'{}", shown(why.path), why.text);
    if (why.path.empty()) return why.text;
    if (why.path.front() == '[' && why.path.find(']') == why.path.size() - 1) {
        return fmt::format("element {} {}", why.path.substr(1, why.path.size() - 2), why.text);
    }
    return fmt::format("field '{}' {}", why.path, why.text);
}

void push_payload(lua_State* L, const ValueView& value) {
    luaL_checkstack(L, codec_stack, "a value");
    detail::push_any(L, value);
}

void fill_fields(lua_State* L, const ValueView& value) {
    for (const Type::Field& field : value.type->fields) {
        lua_pushlstring(L, field.name.data(), field.name.size());
        detail::push_any(L, value.field(field));
        lua_rawset(L, -3);
    }
}

Expected<Value> read_payload(lua_State* L, int index, const MessageType* type) {
    if (lua_checkstack(L, codec_stack) == 0) return failure("not enough memory");
    Value value = make_payload(type);
    Mismatch why;
    if (!detail::read_any(L, lua_absindex(L, index), value, &why)) return failure(describe(why));
    return value;
}

bool read_described(lua_State* L, int index, const ValuePlace& out) {
    out.reset();
    return detail::read_any(L, index, out, nullptr);
}

std::ptrdiff_t read_array_size(lua_State* L, int index, Mismatch* why) {
    std::ptrdiff_t count = 0;
    lua_Integer largest = 0;
    std::string other;
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
        lua_pop(L, 1);
        const bool whole = lua_isinteger(L, -1) != 0;
        if (whole && lua_tointeger(L, -1) >= 1) {
            ++count;
            largest = std::max(largest, lua_tointeger(L, -1));
        } else if (why != nullptr) {
            const std::string name = key_name(L, -1);
            if (other.empty() || name < other) other = name;
        } else {
            lua_pop(L, 1);
            return -1;
        }
    }
    if (!other.empty()) {
        refuse(why, fmt::format("expected an array (elements 1, 2, ...), got a table with the key '{}'", shown(other)));
        return -1;
    }
    if (largest == count) return count;
    if (why != nullptr) {
        lua_Integer hole = 1;
        while (lua_rawgeti(L, index, hole) != LUA_TNIL) {
            lua_pop(L, 1);
            ++hole;
        }
        lua_pop(L, 1);
        refuse(why, fmt::format("expected an array without holes, got no element {} before element {}", hole, largest));
    }
    return -1;
}

namespace detail {
namespace {

// Puts "name" or "[3]" before the path.
void prepend(Mismatch* why, std::string_view place) {
    const bool dot = !why->path.empty() && why->path.front() != '[';
    why->path = std::string(place) + (dot ? "." : "") + why->path;
}

// Whether all keys of the table at `index` are in `names`. If not, describes the unknown key that is first in
// alphabetical order.
bool check_names(lua_State* L, int index, const std::vector<std::string_view>& names, Mismatch* why) {
    std::string unknown;
    bool found = false;
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
        lua_pop(L, 1);
        std::string name = key_name(L, -1);
        const bool known = lua_type(L, -1) == LUA_TSTRING && contains(names, name);
        if (known || (found && name >= unknown)) continue;
        unknown = std::move(name);
        found = true;
    }
    if (!found) return true;
    std::string hint = did_you_mean(unknown, names);
    *why = {.path = unknown, .text = hint.empty() ? list_of(names) : std::move(hint), .unknown = true};
    return false;
}

bool keeps_limits(const Type::Field& field, const ValuePlace& value, Mismatch* why) {
    if (field.limits == nullptr || fits(*field.limits, value.view())) return true;
    return why != nullptr && refuse(why, explain_misfit(*field.limits, value.view()));
}

// Reads in one pass over the keys, and describes no error. The keys are often in the order of the fields, so the search
// begins at the next field.
bool read_fields_at_once(lua_State* L, int index, const ValuePlace& out) {
    const auto& fields = out.type->fields;
    std::size_t next = 0;
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
        bool fits = false;
        if (lua_type(L, -2) == LUA_TSTRING) {
            const std::string_view key = key_text(L);
            for (std::size_t tried = 0; tried < fields.size(); ++tried) {
                const Type::Field& field = fields[next];
                next = next + 1 < fields.size() ? next + 1 : 0;
                if (field.name != key) continue;
                const ValuePlace place = out.field(field);
                fits = read_any(L, lua_gettop(L), place, nullptr, field.numbers) && keeps_limits(field, place, nullptr);
                break;
            }
        }
        if (!fits) {
            lua_pop(L, 2);
            return false;
        }
        lua_pop(L, 1);
    }
    return true;
}

// If `why` is null, reads in one pass.
bool read_any_fields(lua_State* L, int index, const ValuePlace& out, Mismatch* why) {
    if (lua_type(L, index) != LUA_TTABLE) return refuse_type(L, index, "a table", why);
    const UnlockedTable table(L, index);
    if (why == nullptr) return read_fields_at_once(L, table.index(), out);
    std::vector<std::string_view> names;
    for (const Type::Field& field : out.type->fields) {
        names.push_back(field.name);
        if (!push_raw_field(L, table.index(), field.name)) continue;
        const ValuePlace place = out.field(field);
        const bool fits = read_any(L, lua_gettop(L), place, why, field.numbers) && keeps_limits(field, place, why);
        lua_pop(L, 1);
        if (fits) continue;
        prepend(why, field.name);
        return false;
    }
    return check_names(L, table.index(), names, why);
}

bool read_any_elements(lua_State* L, int index, const ValuePlace& out, Mismatch* why, Numbers numbers) {
    if (lua_type(L, index) != LUA_TTABLE) return refuse_type(L, index, "an array", why);
    const UnlockedTable table(L, index);
    const std::ptrdiff_t size = read_array_size(L, table.index(), why);
    if (size < 0) return false;
    if (out.type->kind == Type::Kind::array) {
        if (static_cast<std::size_t>(size) != out.type->length)
            return why != nullptr && refuse(why, fmt::format("expected {} elements, got {}", out.type->length, size));
    } else {
        out.resize(0);
        out.resize(static_cast<std::size_t>(size));
    }
    lua_Integer at = 0;
    bool fits = true;
    for_each_element(out, [&](const ValuePlace& element) {
        lua_rawgeti(L, table.index(), ++at);
        fits = read_any(L, lua_gettop(L), element, why, numbers);
        lua_pop(L, 1);
        return fits;
    });
    if (!fits && why != nullptr) prepend(why, fmt::format("[{}]", at));
    return fits;
}

// Reads a choice of an enumeration, which Lua gives by its name.
bool read_choice(lua_State* L, int index, const ValuePlace& out, Mismatch* why) {
    std::string_view text;
    if (!read_text(L, index, text, why)) return false;
    const std::vector<std::string>& choices = out.type->choices;
    const auto found = std::find(choices.begin(), choices.end(), text);
    if (found != choices.end()) {
        out.set_choice(static_cast<std::size_t>(found - choices.begin()));
        return true;
    }
    if (why == nullptr) return false;
    const std::string near = did_you_mean(text, {choices.begin(), choices.end()});
    return refuse(why, fmt::format("expected one of {}, got '{}'{}", fmt::join(choices, ", "), shown(text), near));
}

}  // namespace

bool read_boolean(lua_State* L, int index, bool& out, Mismatch* why) {
    if (lua_type(L, index) != LUA_TBOOLEAN) return refuse_type(L, index, "a boolean", why);
    out = lua_toboolean(L, index) != 0;
    return true;
}

bool read_integer(lua_State* L, int index, std::int64_t min, std::int64_t max, std::int64_t& out, Mismatch* why) {
    if (lua_type(L, index) != LUA_TNUMBER) return refuse_type(L, index, "an integer", why);
    std::string found;
    if (lua_isinteger(L, index) != 0) {
        out = lua_tointeger(L, index);
        if (out >= min && out <= max) return true;
        if (why != nullptr) found = fmt::format("{}", out);
    } else {
        const double number = number_at(L, index);
        if (const auto whole = whole_number(number)) {
            out = *whole;
            if (out >= min && out <= max) return true;
        } else if (std::isnan(number) || std::isinf(number) || number != std::floor(number)) {
            return why != nullptr && refuse(why, fmt::format("expected an integer, got {}", number));
        }
        if (why != nullptr) found = fmt::format("{}", number);
    }
    return why != nullptr && refuse(why, fmt::format("expected an integer from {} to {}, got {}", min, max, found));
}

bool read_number(lua_State* L, int index, double max, double& out, Mismatch* why, Numbers numbers) {
    if (lua_type(L, index) != LUA_TNUMBER) return refuse_type(L, index, "a number", why);
    out = number_at(L, index);
    if (std::fabs(out) <= max || (numbers == Numbers::any && !std::isfinite(out))) return true;
    if (why == nullptr) return false;
    if (!std::isfinite(out)) return refuse(why, fmt::format("expected a finite number, got {}", out));
    return refuse(why, fmt::format("expected a number from {0} to {1}, got {2}", -max, max, out));
}

bool read_text(lua_State* L, int index, std::string_view& out, Mismatch* why) {
    if (lua_type(L, index) != LUA_TSTRING) return refuse_type(L, index, "a string", why);
    std::size_t size = 0;
    const char* text = lua_tolstring(L, index, &size);
    out = {text, size};
    return true;
}

void push_any(lua_State* L, const ValueView& value) {
    switch (value.type->kind) {
        case Type::Kind::structure:
            lua_createtable(L, 0, static_cast<int>(value.type->fields.size()));
            return fill_fields(L, value);
        case Type::Kind::array:
        case Type::Kind::sequence: {
            lua_createtable(L, static_cast<int>(value.count()), 0);
            lua_Integer index = 0;
            for_each_element(value, [&](const ValueView& element) {
                push_any(L, element);
                lua_rawseti(L, -2, ++index);
                return true;
            });
            return;
        }
        case Type::Kind::enumeration: return push_value(L, value.type->choices[value.choice()]);
        case Type::Kind::text: return push_value(L, value.as<std::string>());
        case Type::Kind::octets: return push_value(L, value.as<Octets>());
        case Type::Kind::any: return push_any(L, value.as<Value>());
        case Type::Kind::nothing:
        case Type::Kind::other: return lua_pushnil(L);
        default:
            return visit_number(value, [L]<class T>(const T& number) {
                if constexpr (std::is_same_v<T, std::uint64_t>) {
                    if (number > std::uint64_t{std::numeric_limits<std::int64_t>::max()})
                        luaL_error(L, "the value has an integer larger than 2^63 - 1, the largest integer of Lua");
                }
                push_value(L, number);
            });
    }
}

bool read_any(lua_State* L, int index, const ValuePlace& out, Mismatch* why, Numbers numbers) {
    switch (out.type->kind) {
        case Type::Kind::structure: return read_any_fields(L, index, out, why);
        case Type::Kind::array:
        case Type::Kind::sequence: return read_any_elements(L, index, out, why, numbers);
        case Type::Kind::enumeration: return read_choice(L, index, out, why);
        case Type::Kind::boolean: return read_boolean(L, index, out.as<bool>(), why);
        case Type::Kind::text:
        case Type::Kind::octets: {
            std::string_view text;
            if (!read_text(L, index, text, why)) return false;
            if (out.type->kind == Type::Kind::text) {
                out.as<std::string>() = text;
            } else {
                out.as<Octets>().assign(text.begin(), text.end());
            }
            return true;
        }
        default:
            return visit_number(out, [&]<class T>(T& number) {
                using Wide = std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>;
                Wide wide = 0;
                if constexpr (std::is_floating_point_v<T>) {
                    if (!read_number(L, index, std::numeric_limits<T>::max(), wide, why, numbers)) return false;
                } else {
                    const auto [min, max] = out.type->integer_range();
                    if (!read_integer(L, index, min, max, wide, why)) return false;
                }
                number = static_cast<T>(wide);
                return true;
            });
    }
}

bool push_raw_field(lua_State* L, int index, std::string_view name) {
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
        if (lua_type(L, -2) == LUA_TSTRING && key_text(L) == name) {
            lua_remove(L, -2);
            return true;
        }
        lua_pop(L, 1);
    }
    return false;
}

std::string_view key_text(lua_State* L) {
    std::size_t size = 0;
    const char* text = lua_tolstring(L, -2, &size);
    return {text, size};
}

}  // namespace detail

bool read_fields(lua_State* L, int first, std::span<const Type::Field* const> fields, const ValuePlace& out) {
    out.reset();
    for (const Type::Field* const field : fields) {
        const int index = first++;
        const ValuePlace place = out.field(*field);
        if (lua_isnil(L, index)) continue;
        if (!detail::read_any(L, index, place, nullptr, field->numbers) ||
            !detail::keeps_limits(*field, place, nullptr))
            return false;
    }
    return true;
}

}  // namespace nezumi

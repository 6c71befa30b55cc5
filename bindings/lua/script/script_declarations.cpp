// Reads declarations strictly: an unknown option is an error with the nearest name.
#include "bindings/lua/script/script_declarations.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "bindings/lua/files/read_options.hpp"
#include "bindings/lua/script/declaration_fields.hpp"
#include "bindings/lua/script/script_call.hpp"
#include "bindings/lua/script/script_config.hpp"
#include "bindings/lua/script/script_ports.hpp"
#include "bindings/lua/values/codec.hpp"
#include "engine/components/parameter_fields.hpp"

namespace nezumi {
namespace {

// Checks the number of arguments. Then the stack has `most` arguments; omitted ones are nil.
Expected<void> take_arguments(lua_State* L, std::string_view function, int most, std::string_view usage) {
    auto ok = Arguments{L}.at_most(function, most, usage);
    if (ok) lua_settop(L, most);
    return ok;
}

// The string at `index`, or an empty one if there is no value; an error for other values.
Expected<std::string> text_at(lua_State* L, int index, std::string_view what) {
    if (lua_isnoneornil(L, index)) return std::string();
    if (lua_type(L, index) != LUA_TSTRING)
        return failure(fmt::format("{} expected a string, got {}", what, luaL_typename(L, index)));
    std::size_t size = 0;
    const char* text = lua_tolstring(L, index, &size);
    return std::string(text, size);
}

// input(name, type, doc, { queue = n }) and output(name, type, doc, { safe = value })

Expected<PortSlot*> declare_port(lua_State* L, Script& script, Direction direction) {
    const std::string_view function = direction == Direction::in ? "input" : "output";
    PortDeclaration port{
        .direction = direction, .name = {}, .type = nullptr, .doc = {}, .queue = 0, .safe = {}, .place = caller(L)};
    if (auto ok = take_arguments(L, function, 4, "(name, type, doc, options)"); !ok) return Unexpected(ok.error());
    if (lua_type(L, 1) != LUA_TSTRING)
        return failure(fmt::format("{}: its name expected a string, got {}", function, luaL_typename(L, 1)));
    port.name = *text_at(L, 1, "");
    const auto refuse = [&](const Error& error) {
        return failure(fmt::format("{} '{}': {}", function, shown(port.name), error.message));
    };
    if (lua_type(L, 2) != LUA_TSTRING) {
        return refuse(
            {fmt::format("its type expected a string such as \"TimedVelocity2D\", got {}", luaL_typename(L, 2))});
    }
    auto type = script.find_message(*text_at(L, 2, ""));
    if (!type) return type.error().place.file.empty() ? refuse(type.error()) : Unexpected(type.error());
    port.type = *type;
    const int options = lua_type(L, 3) == LUA_TTABLE && lua_isnoneornil(L, 4) ? 3 : 4;
    if (options == 4) {
        auto doc = text_at(L, 3, "its description");
        if (!doc) return refuse(doc.error());
        port.doc = std::move(*doc);
    }
    const auto read_safe = [&](Fields& fields) {
        if (direction == Direction::in || !fields.gives("safe")) return;
        detail::push_raw_field(L, options, "safe");
        auto safe = read_payload(L, -1, port.type);
        lua_pop(L, 1);
        if (!safe) {
            return fields.check().wrong({"safe"}, fmt::format("({}): {}", port.type->name, safe.error().message));
        }
        port.safe.push_back(std::move(*safe));
    };
    const unsigned kind = 1U << static_cast<unsigned>(direction);
    if (auto ok = read_options(L, options, FieldCheck::of_options(fmt::format("{} '{}'", function, shown(port.name))),
                               port, {.kind = kind}, read_safe);
        !ok)
        return Unexpected(ok.error());
    return script.declare_port(std::move(port));
}

int global_port(lua_State* L, Direction direction) {
    Script& script = script_of(L);
    PortSlot* slot = nullptr;
    const bool declared = declare(
        L, script, [&] { return declare_port(L, script, direction).map([&](PortSlot* made) { slot = made; }); });
    if (declared) {
        push_port_object(L, *slot);
    } else {
        lua_newtable(L);  // in place of the port, so that loading can continue
    }
    return 1;
}

int global_input(lua_State* L) { return global_port(L, Direction::in); }
int global_output(lua_State* L) { return global_port(L, Direction::out); }

// param(name, default, { min, max, step, widget, unit, doc, choices, min_size, max_size })

void read_choices(Fields& options, ParameterSpec& spec) {
    const Value* value = options.field("choices");
    if (value == nullptr) return;
    const auto refuse = [&](const std::string& why) { options.check().wrong({"choices"}, why); };
    const FileTable* table = value->get_if<FileTable>();
    if (table == nullptr || !table->fields.empty())
        return refuse(fmt::format("expected an array, got {}", table == nullptr ? kind_of(*value) : "another table"));
    if (table->elements.empty()) return refuse("is empty: there is nothing to choose");
    for (std::size_t i = 0; i < table->elements.size(); ++i) {
        auto choice = to_parameter(table->elements[i]);
        if (!choice) return refuse(fmt::format("element {} {}", i + 1, choice.error().message));
        spec.choices.push_back(std::move(*choice));
    }
}

// An option that does not fit the type of the default gets its own message.
void check_kinds(Fields& options, const ParameterSpec& spec, unsigned kind) {
    for (const Type::Field& field : record_of<ParameterSpec>().fields) {
        const unsigned of = field.rule->of;
        if (of == 0 || (of & kind) != 0 || !options.gives(field.name)) continue;
        options.field(field.name);
        options.check().wrong({field.name}, fmt::format("is for {}, and the parameter is of type {}",
                                                        of == Describe<ParameterSpec>::arrays ? "arrays" : "numbers",
                                                        type_text(spec.initial)));
    }
}

Expected<void> declare_parameter(lua_State* L, Script& script) {
    if (auto ok = take_arguments(L, "param", 3, "(name, default, options)"); !ok) return ok;
    ParameterSpec spec;
    spec.place = caller(L);
    if (lua_type(L, 1) != LUA_TSTRING)
        return failure(fmt::format("param: its name expected a string, got {}", luaL_typename(L, 1)));
    spec.name = *text_at(L, 1, "");
    const auto refuse = [&](const Error& error) {
        return failure(fmt::format("parameter '{}': {}", shown(spec.name), error.message));
    };
    auto initial = read_parameter(L, 2);
    if (!initial) return refuse({"its default " + initial.error().message});
    spec.initial = std::move(*initial);
    const bool is_array = spec.initial.type().kind == Type::Kind::sequence;
    const bool is_number = spec.initial.type().single().is_number();
    const unsigned kind = is_number ? (is_array ? 2U : 1U) : (is_array ? 4U : 8U);
    const auto by_hand = [&](Fields& options) {
        check_kinds(options, spec, kind);
        read_choices(options, spec);
    };
    if (auto ok = read_options(L, 3, FieldCheck::of_options(fmt::format("parameter '{}'", shown(spec.name))), spec,
                               {.kind = kind}, by_hand);
        !ok)
        return ok;
    return script.declare_parameter(std::move(spec));
}

int global_param(lua_State* L) {
    Script& script = script_of(L);
    if (declare(L, script, [&] { return declare_parameter(L, script); }))
        show_parameter(L, script.parameters().all().back());
    return 0;
}

// command(name, fn, doc)
int global_command(lua_State* L) {
    Script& script = script_of(L);
    const int function = keep_function(L);
    declare(L, script, [&]() -> Expected<void> {
        if (auto ok = take_arguments(L, "command", 3, "(name, function, doc)"); !ok) return ok;
        CommandDeclaration command{.name = {}, .doc = {}, .place = caller(L)};
        if (lua_type(L, 1) != LUA_TSTRING)
            return failure(fmt::format("command: its name expected a string, got {}", luaL_typename(L, 1)));
        command.name = *text_at(L, 1, "");
        if (function == LUA_NOREF) {
            return failure(fmt::format("command '{}': expected a function, got {}", command.name, luaL_typename(L, 2)));
        }
        auto doc = text_at(L, 3, "its description");
        if (!doc) return failure(fmt::format("command '{}': {}", command.name, doc.error().message));
        command.doc = std::move(*doc);
        return script.declare_command(std::move(command), function);
    });
    return 0;
}

// about { version =, vendor =, category = }
int global_about(lua_State* L) {
    Script& script = script_of(L);
    declare(L, script, [&]() -> Expected<void> {
        if (auto ok = take_arguments(L, "about", 1, " { version =, vendor =, category = }"); !ok) return ok;
        ScriptAbout about{.version = {}, .vendor = {}, .category = {}, .given = true};
        if (lua_type(L, 1) != LUA_TTABLE)
            return failure(fmt::format("about expected a table, got {}", luaL_typename(L, 1)));
        if (auto ok = read_options(L, 1, FieldCheck::of_options("about"), about); !ok) return ok;
        return script.declare_about(std::move(about));
    });
    return 0;
}

// constants(type): a table of the constants that the definition of a message type has
int global_constants(lua_State* L) {
    const MessageType* type = nullptr;
    bridge(L, [&]() -> Expected<void> {
        if (auto ok = Arguments{L}.at_most("constants", 1, "(type)"); !ok) return ok;
        const auto name = Arguments{L}.text(1, "a type's name");
        if (!name) return failure("constants: " + name.error().message);
        const auto found = script_of(L).find_message(*name);
        if (!found) {
            return found.error().place.file.empty() ? failure("constants: " + found.error().message)
                                                    : Unexpected(found.error());
        }
        type = *found;
        return {};
    });
    lua_createtable(L, 0, static_cast<int>(type->constants.size()));
    for (const auto& [name, value] : type->constants) {
        lua_pushlstring(L, name.data(), name.size());
        // As a number that is written in Lua: too large for an integer, it is a float.
        if (const auto* large = value.get_if<std::uint64_t>()) {
            lua_pushnumber(L, static_cast<double>(*large));
        } else {
            push_payload(L, value);
        }
        lua_rawset(L, -3);
    }
    return 1;
}

}  // namespace

void set_declaring_globals(lua_State* L, Script& script) {
    set_function(L, script, "input", global_input);
    set_function(L, script, "output", global_output);
    set_function(L, script, "param", global_param);
    set_function(L, script, "command", global_command);
    set_function(L, script, "about", global_about);
    set_function(L, script, "constants", global_constants);
}

}  // namespace nezumi

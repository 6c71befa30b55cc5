// Reads declarations strictly: an option that is not known is an error with the nearest.
#include "bindings/lua/script/script_declarations.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/script/script_call.hpp"
#include "bindings/lua/script/script_config.hpp"
#include "bindings/lua/script/script_ports.hpp"
#include "bindings/lua/values/codec.hpp"

namespace nezumi {
namespace {

// All of a word's arguments lie on the stack after this, nil where none is given.
Expected<void> take_arguments(lua_State* L, std::string_view word, int most, std::string_view usage) {
    auto ok = Arguments{L}.at_most(word, most, usage);
    if (ok) lua_settop(L, most);
    return ok;
}

// The string at `index`, or an empty one when nothing is there, or why it is neither.
Expected<std::string> text_at(lua_State* L, int index, std::string_view what) {
    if (lua_isnoneornil(L, index)) return std::string();
    if (lua_type(L, index) != LUA_TSTRING)
        return failure(fmt::format("{} expected a string, got {}", what, luaL_typename(L, index)));
    std::size_t size = 0;
    const char* text = lua_tolstring(L, index, &size);
    return std::string(text, size);
}

Expected<double> number_at(lua_State* L, int index, std::string_view what) {
    if (lua_type(L, index) != LUA_TNUMBER)
        return failure(fmt::format("{} expected a number, got {}", what, luaL_typename(L, index)));
    return lua_tonumber(L, index);
}

Expected<std::size_t> count_at(lua_State* L, int index, std::int64_t least, std::int64_t most, std::string_view what) {
    std::int64_t value = 0;
    Mismatch why;
    if (!detail::read_integer(L, index, least, most, value, &why)) return failure(fmt::format("{} {}", what, why.text));
    return static_cast<std::size_t>(value);
}

// Calls `read(name)` with the value on top of the stack for every option given. Nothing at `index` means no options.
template <class Read>
Expected<void> read_options(lua_State* L, int index, const std::vector<std::string_view>& names, const Read& read) {
    if (lua_isnoneornil(L, index)) return {};
    if (lua_type(L, index) != LUA_TTABLE)
        return failure(fmt::format("options expected a table, got {}", luaL_typename(L, index)));
    std::ptrdiff_t given = 0;
    for (const std::string_view name : names) {
        if (!detail::push_raw_field(L, index, name)) continue;
        ++given;
        Expected<void> ok = read(name);
        lua_pop(L, 1);
        if (!ok) return ok;
    }
    std::ptrdiff_t present = 0;
    lua_pushnil(L);
    while (lua_next(L, index) != 0) {
        lua_pop(L, 1);
        ++present;
    }
    if (present == given) return {};
    Mismatch why;
    detail::explain_unknown(L, index, names, &why);
    std::string text = describe(why);
    text.replace(0, std::string_view("unknown field").size(), "unknown option");
    if (const auto fields = text.find("(its fields are"); fields != std::string::npos)
        text.replace(fields, 15, "(the options are");
    return failure(std::move(text));
}

// input(name, type, doc, { queue = n }) and output(name, type, doc, { safe = value })

Expected<PortSlot*> declare_port(lua_State* L, Script& script, Direction direction) {
    const std::string_view word = direction == Direction::in ? "input" : "output";
    PortDeclaration port{
        .direction = direction, .name = {}, .type = 0, .doc = {}, .queue = 0, .safe = {}, .place = caller(L)};
    if (auto ok = take_arguments(L, word, 4, "(name, type, doc, options)"); !ok) return Unexpected(ok.error());
    if (lua_type(L, 1) != LUA_TSTRING)
        return failure(fmt::format("{}: its name expected a string, got {}", word, luaL_typename(L, 1)));
    port.name = *text_at(L, 1, "");
    const auto refuse = [&](const Error& error) {
        return failure(fmt::format("{} '{}': {}", word, shown(port.name), error.message));
    };
    if (lua_type(L, 2) != LUA_TSTRING) {
        return refuse(
            {fmt::format("its type expected a string such as \"TimedVelocity2D\", got {}", luaL_typename(L, 2))});
    }
    auto type = find_message_type(*text_at(L, 2, ""));
    if (!type) return refuse(type.error());
    port.type = *type;
    const int options = lua_type(L, 3) == LUA_TTABLE && lua_isnoneornil(L, 4) ? 3 : 4;
    if (options == 4) {
        auto doc = text_at(L, 3, "its description");
        if (!doc) return refuse(doc.error());
        port.doc = std::move(*doc);
    }
    const std::vector<std::string_view> names{direction == Direction::in ? "queue" : "safe"};
    const auto read = [&](std::string_view) -> Expected<void> {
        if (direction == Direction::in) {
            return count_at(L, lua_gettop(L), 1, 100'000, "option 'queue'").map([&](std::size_t n) { port.queue = n; });
        }
        auto safe = read_payload(L, -1, port.type);
        if (!safe)
            return failure(fmt::format("option 'safe' ({}): {}", message_type_names[port.type], safe.error().message));
        port.safe.push_back(std::move(*safe));
        return {};
    };
    if (auto ok = read_options(L, options, names, read); !ok) return refuse(ok.error());
    return script.declare_port(std::move(port));
}

int word_port(lua_State* L, Direction direction) {
    Script& script = script_of(L);
    PortSlot* slot = nullptr;
    const bool declared = declare(
        L, script, [&] { return declare_port(L, script, direction).map([&](PortSlot* made) { slot = made; }); });
    if (declared) {
        push_port_object(L, *slot);
    } else {
        lua_newtable(L);  // stands in for the port
    }
    return 1;
}

int word_input(lua_State* L) { return word_port(L, Direction::in); }
int word_output(lua_State* L) { return word_port(L, Direction::out); }

// param(name, default, { min, max, step, widget, unit, doc, choices, min_size, max_size })

Expected<std::vector<ParameterValue>> read_choices(lua_State* L, int index) {
    Mismatch why{.path = "", .text = fmt::format("expected an array, got {}", luaL_typename(L, index))};
    const std::ptrdiff_t size = lua_type(L, index) == LUA_TTABLE ? read_array_size(L, index, &why) : -1;
    if (size < 0) return failure("option 'choices' " + describe(why));
    if (size == 0) return failure("option 'choices' is empty: nothing could be chosen");
    std::vector<ParameterValue> choices;
    for (std::ptrdiff_t i = 1; i <= size; ++i) {
        lua_rawgeti(L, index, i);
        auto choice = read_parameter(L, -1);
        lua_pop(L, 1);
        if (!choice) return failure(fmt::format("option 'choices': element {} {}", i, choice.error().message));
        choices.push_back(std::move(*choice));
    }
    return choices;
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
    const bool is_array = spec.initial.index() >= 4;
    const bool is_number = spec.initial.index() % 4 == 1 || spec.initial.index() % 4 == 2;

    const auto read = [&](std::string_view name) -> Expected<void> {
        const int value = lua_gettop(L);
        const std::string what = fmt::format("option '{}'", name);
        const auto text = [&](std::string& out) {
            return text_at(L, value, what).map([&](std::string t) { out = std::move(t); });
        };
        if (name == "widget") return text(spec.widget);
        if (name == "unit") return text(spec.unit);
        if (name == "doc") return text(spec.doc);
        if (name == "choices") return read_choices(L, value).map([&](auto all) { spec.choices = std::move(all); });
        if (name == "min_size" || name == "max_size") {
            if (!is_array)
                return failure(
                    fmt::format("{} is for arrays, and the parameter is of type {}", what, type_text(spec.initial)));
            return count_at(L, value, 0, 1'000'000, what).map([&](std::size_t n) {
                (name == "min_size" ? spec.min_size : spec.max_size) = n;
            });
        }
        if (!is_number)
            return failure(
                fmt::format("{} is for numbers, and the parameter is of type {}", what, type_text(spec.initial)));
        return number_at(L, value, what).map([&](double number) {
            if (name == "min") spec.min = number;
            if (name == "max") spec.max = number;
            if (name == "step") spec.step = number;
        });
    };
    if (auto ok = read_options(L, 3, {"min", "max", "step", "widget", "unit", "doc", "choices", "min_size", "max_size"},
                               read);
        !ok) {
        return refuse(ok.error());
    }
    return script.declare_parameter(std::move(spec));
}

int word_param(lua_State* L) {
    Script& script = script_of(L);
    if (declare(L, script, [&] { return declare_parameter(L, script); }))
        show_parameter(L, script.parameters().all().back());
    return 0;
}

// command(name, fn, doc)
int word_command(lua_State* L) {
    Script& script = script_of(L);
    int function = LUA_NOREF;
    if (lua_type(L, 2) == LUA_TFUNCTION && lua_gettop(L) <= 3) {
        lua_pushvalue(L, 2);
        function = luaL_ref(L, LUA_REGISTRYINDEX);
    }
    declare(L, script, [&]() -> Expected<void> {
        if (auto ok = take_arguments(L, "command", 3, "(name, function, doc)"); !ok) return ok;
        CommandDeclaration command{.name = {}, .doc = {}, .function = function, .place = caller(L)};
        if (lua_type(L, 1) != LUA_TSTRING)
            return failure(fmt::format("command: its name expected a string, got {}", luaL_typename(L, 1)));
        command.name = *text_at(L, 1, "");
        if (function == LUA_NOREF) {
            return failure(fmt::format("command '{}': expected a function, got {}", command.name, luaL_typename(L, 2)));
        }
        auto doc = text_at(L, 3, "its description");
        if (!doc) return failure(fmt::format("command '{}': {}", command.name, doc.error().message));
        command.doc = std::move(*doc);
        return script.declare_command(std::move(command));
    });
    return 0;
}

// about { version =, vendor =, category = }
int word_about(lua_State* L) {
    Script& script = script_of(L);
    declare(L, script, [&]() -> Expected<void> {
        if (auto ok = take_arguments(L, "about", 1, " { version =, vendor =, category = }"); !ok) return ok;
        ScriptAbout about{.version = {}, .vendor = {}, .category = {}, .given = true};
        if (lua_type(L, 1) != LUA_TTABLE)
            return failure(fmt::format("about expected a table, got {}", luaL_typename(L, 1)));
        const auto read = [&](std::string_view name) {
            std::string& field = name == "version" ? about.version : name == "vendor" ? about.vendor : about.category;
            return text_at(L, lua_gettop(L), fmt::format("'{}'", name)).map([&](std::string text) {
                field = std::move(text);
            });
        };
        if (auto ok = read_options(L, 1, {"version", "vendor", "category"}, read); !ok)
            return failure("about: " + ok.error().message);
        return script.declare_about(std::move(about));
    });
    return 0;
}

}  // namespace

void set_declaring_words(lua_State* L, Script& script) {
    set_word(L, script, "input", word_input);
    set_word(L, script, "output", word_output);
    set_word(L, script, "param", word_param);
    set_word(L, script, "command", word_command);
    set_word(L, script, "about", word_about);
}

}  // namespace nezumi

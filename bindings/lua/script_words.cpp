// Every word is a C function that carries its script. What it reads from Lua it reads without raising; then it raises.
#include "bindings/lua/script_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "bindings/lua/codec.hpp"
#include "bindings/lua/locked_table.hpp"
#include "bindings/lua/ordered.hpp"
#include "bindings/lua/script_ports.hpp"
#include "bindings/lua/text.hpp"

namespace nezumi {
namespace {

// Addresses that are keys of the registry.
constexpr char config_values_key = 0;
constexpr char state_key = 0;
constexpr char modules_key = 0;

Script& script_of(lua_State* L) { return *static_cast<Script*>(lua_touserdata(L, lua_upvalueindex(1))); }

void push_closure(lua_State* L, Script& script, lua_CFunction function) {
    lua_pushlightuserdata(L, &script);
    lua_pushcclosure(L, function, 1);
}

void set_word(lua_State* L, Script& script, const char* name, lua_CFunction function) {
    push_closure(L, script, function);
    lua_setfield(L, -2, name);
}

// The line of the script that calls the running C function.
Place caller(lua_State* L) {
    lua_Debug activation;
    if (lua_getstack(L, 1, &activation) == 0 || lua_getinfo(L, "Sl", &activation) == 0 || activation.currentline <= 0)
        return {};
    const char* file = *activation.source == '@' ? activation.source + 1 : activation.short_src;
    return {file, activation.currentline};
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
    lua_settop(L, 4);
    PortSlot* slot = nullptr;
    {
        auto declared = declare_port(L, script, direction);
        if (declared) {
            slot = *declared;
        } else {
            script.raised = std::move(declared.error().message);
        }
    }
    if (slot == nullptr) return script.raise(L);
    push_port_object(L, *slot);
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

// One value of `config` on top of the stack: arrays are locked.
void push_config_value(lua_State* L, Script& script, const Parameters::Parameter& parameter) {
    push_parameter(L, parameter.value);
    if (lua_type(L, -1) != LUA_TTABLE) return;
    script.raised = "config." + parameter.spec.name;
    lock_table(L, script.raised.c_str());
}

// Runs `body`, which fills `raised` with the message of an error; then raises it.
template <class Body>
int finish(lua_State* L, Script& script, Body&& body) {
    bool failed = false;
    {
        Expected<void> ok = body();
        if (!ok) {
            script.raised = std::move(ok.error().message);
            failed = true;
        }
    }
    return failed ? script.raise(L) : 0;
}

int word_param(lua_State* L) {
    Script& script = script_of(L);
    lua_settop(L, 3);
    finish(L, script, [&] { return declare_parameter(L, script); });
    lua_rawgetp(L, LUA_REGISTRYINDEX, &config_values_key);
    lua_pushvalue(L, 1);
    push_config_value(L, script, script.parameters().all().back());
    lua_rawset(L, -3);
    return 0;
}

// command(name, fn, doc)
int word_command(lua_State* L) {
    Script& script = script_of(L);
    lua_settop(L, 3);
    int function = LUA_NOREF;
    if (lua_type(L, 2) == LUA_TFUNCTION) {
        lua_pushvalue(L, 2);
        function = luaL_ref(L, LUA_REGISTRYINDEX);
    }
    return finish(L, script, [&]() -> Expected<void> {
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
}

// about { version =, vendor =, category = }
int word_about(lua_State* L) {
    Script& script = script_of(L);
    lua_settop(L, 1);
    return finish(L, script, [&]() -> Expected<void> {
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
}

// config.name

int unknown_parameter(lua_State* L) {
    Script& script = script_of(L);
    push_text(L, 2);
    return finish(L, script, [&]() -> Expected<void> {
        std::vector<std::string_view> names;
        for (const auto& parameter : script.parameters().all()) names.push_back(parameter.spec.name);
        const std::string_view name = lua_tostring(L, -1);
        return failure(fmt::format("unknown parameter '{}'{}", shown(name), did_you_mean(name, names)));
    });
}

int config_newindex(lua_State* L) {
    Script& script = script_of(L);
    push_text(L, 2);
    return finish(L, script, [&]() -> Expected<void> {
        const std::string_view name = lua_tostring(L, -1);
        if (script.phase() == Script::Phase::loading) {
            return failure(fmt::format("config.{} can't be set while the file loads", shown(name)));
        }
        auto value = read_parameter(L, 3);
        if (!value) return failure(fmt::format("parameter '{}': {}", shown(name), value.error().message));
        return script.parameters().stage(name, *value);
    });
}

int config_pairs(lua_State* L) {
    lua_settop(L, 0);
    lua_pushcfunction(L, ordered_pairs);
    lua_rawgetp(L, LUA_REGISTRYINDEX, &config_values_key);
    lock_table(L, "config");
    lua_call(L, 1, 3);
    return 3;
}

void push_config(lua_State* L, Script& script) {
    lua_newuserdatauv(L, 0, 0);
    lua_createtable(L, 0, 5);
    lua_newtable(L);  // the values
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &config_values_key);
    lua_createtable(L, 0, 1);
    set_word(L, script, "__index", unknown_parameter);
    lua_setmetatable(L, -2);
    lua_setfield(L, -2, "__index");
    set_word(L, script, "__newindex", config_newindex);
    lua_pushcfunction(L, config_pairs);
    lua_setfield(L, -2, "__pairs");
    lua_pushliteral(L, "config");
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

// now(), log.*

int word_now(lua_State* L) {
    lua_pushnumber(L, script_of(L).seconds());
    return 1;
}

template <LogLevel level>
int word_log(lua_State* L) {
    const int count = lua_gettop(L);
    luaL_Buffer line;
    luaL_buffinit(L, &line);
    for (int i = 1; i <= count; ++i) {
        if (i > 1) luaL_addchar(&line, '\t');
        push_text(L, i);
        luaL_addvalue(&line);
    }
    luaL_pushresult(&line);
    std::size_t size = 0;
    const char* text = lua_tolstring(L, -1, &size);
    script_of(L).log(level, std::string(text, size));
    return 0;
}

int unknown_level(lua_State* L) {
    Script& script = script_of(L);
    push_text(L, 2);
    return finish(L, script, [&]() -> Expected<void> {
        const std::string_view name = lua_tostring(L, -1);
        const std::string near = did_you_mean(name, {"debug", "info", "warn", "error"});
        return failure(
            fmt::format("log has no '{}'{}", name, near.empty() ? " (it has debug, info, warn, error)" : near));
    });
}

void push_log(lua_State* L, Script& script) {
    lua_createtable(L, 0, 4);
    set_word(L, script, "debug", word_log<LogLevel::debug>);
    set_word(L, script, "info", word_log<LogLevel::info>);
    set_word(L, script, "warn", word_log<LogLevel::warn>);
    set_word(L, script, "error", word_log<LogLevel::error>);
    lua_createtable(L, 0, 1);
    set_word(L, script, "__index", unknown_level);
    lua_setmetatable(L, -2);
    lock_table(L, "log");
}

// require(name)
int word_require(lua_State* L) {
    Script& script = script_of(L);
    lua_settop(L, 1);
    lua_rawgetp(L, LUA_REGISTRYINDEX, &modules_key);
    if (lua_type(L, 1) == LUA_TSTRING) {
        lua_pushvalue(L, 1);
        if (lua_rawget(L, 2) != LUA_TNIL) return 1;
        lua_pop(L, 1);
    }
    finish(L, script, [&]() -> Expected<void> {
        if (lua_type(L, 1) != LUA_TSTRING)
            return failure(fmt::format("require expected a module's name, got {}", luaL_typename(L, 1)));
        return script.begin_module(L, *text_at(L, 1, ""));
    });
    const Chunk& chunk = script.module_chunk();
    if (luaL_loadbufferx(L, chunk.bytecode.data(), chunk.bytecode.size(), "module", "b") != LUA_OK) lua_error(L);
    lua_call(L, 0, 1);
    script.end_module();
    if (lua_isnil(L, -1)) {
        lua_pop(L, 1);
        lua_pushboolean(L, 1);
    }
    lua_pushvalue(L, 1);
    lua_pushvalue(L, -2);
    lua_rawset(L, 2);
    return 1;
}

// Globals: callbacks are taken as they are defined; everything else is a slip.

int global_newindex(lua_State* L) {
    Script& script = script_of(L);
    push_text(L, 2);
    std::size_t hook = 0;
    int line = 0;
    finish(L, script, [&]() -> Expected<void> {
        line = caller(L).line;
        return script.check_hook(lua_tostring(L, -1), luaL_typename(L, 3)).map([&](std::size_t found) {
            hook = found;
        });
    });
    lua_pushvalue(L, 3);
    script.set_hook(hook, luaL_ref(L, LUA_REGISTRYINDEX), line);
    return 0;
}

// `dt` costs those who read it, and nobody else.
int global_index(lua_State* L) {
    Script& script = script_of(L);
    if (lua_type(L, 2) == LUA_TSTRING && std::strcmp(lua_tostring(L, 2), "dt") == 0) {
        lua_pushnumber(L, script.dt());
        return 1;
    }
    push_text(L, 2);
    const int function = script.hook_function(lua_tostring(L, -1));
    if (function == LUA_REFNIL) {
        lua_pushnil(L);
        return 1;
    }
    if (function != LUA_NOREF) {
        lua_rawgeti(L, LUA_REGISTRYINDEX, function);
        return 1;
    }
    return finish(L, script, [&]() -> Expected<void> {
        const std::string_view name = lua_tostring(L, -1);
        return failure(fmt::format("unknown global '{}'{}", name, did_you_mean(name, script_words())));
    });
}

}  // namespace

void install_words(lua_State* L, Script& script, const PlainData* state) {
    luaL_checkstack(L, 12, nullptr);
    lua_newtable(L);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &modules_key);
    lua_pushglobaltable(L);
    set_word(L, script, "input", word_input);
    set_word(L, script, "output", word_output);
    set_word(L, script, "param", word_param);
    set_word(L, script, "command", word_command);
    set_word(L, script, "about", word_about);
    set_word(L, script, "now", word_now);
    set_word(L, script, "require", word_require);
    push_log(L, script);
    lua_setfield(L, -2, "log");
    push_config(L, script);
    lua_setfield(L, -2, "config");
    if (state != nullptr) {
        push_plain(L, *state);
    } else {
        lua_newtable(L);
    }
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &state_key);
    lua_setfield(L, -2, "state");

    lua_createtable(L, 0, 3);
    set_word(L, script, "__index", global_index);
    set_word(L, script, "__newindex", global_newindex);
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
    lua_pop(L, 1);
}

const std::vector<std::string_view>& script_words() {
    static const std::vector<std::string_view> words{"about", "command", "config", "dt",      "input", "log",
                                                     "now",   "output",  "param",  "require", "state"};
    return words;
}

const std::vector<std::string_view>& component_words() {
    static const std::vector<std::string_view> words{"activate", "config", "deactivate", "name", "ports", "reset",
                                                     "sets",     "state",  "status",     "type", "use",   "version"};
    return words;
}

const std::vector<std::string_view>& hook_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> all;
        for (int i = static_cast<int>(Hook::on_activated); i <= static_cast<int>(Hook::on_reload); ++i) {
            all.push_back(to_text(static_cast<Hook>(i)));
        }
        return all;
    }();
    return names;
}

void push_config_values(lua_State* L, Script& script, const Parameters& parameters) {
    luaL_checkstack(L, 10, nullptr);
    lua_rawgetp(L, LUA_REGISTRYINDEX, &config_values_key);
    for (const auto& parameter : parameters.all()) {
        lua_pushlstring(L, parameter.spec.name.data(), parameter.spec.name.size());
        push_config_value(L, script, parameter);
        lua_rawset(L, -3);
    }
    lua_pop(L, 1);
}

void push_state(lua_State* L) { lua_rawgetp(L, LUA_REGISTRYINDEX, &state_key); }

}  // namespace nezumi

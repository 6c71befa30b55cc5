// Opens the sandbox's library in a state.
#include "bindings/lua/sandbox/stdlib.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/library.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/missing_names.hpp"

namespace nezumi {
namespace library {
namespace {

using StockFunctions = std::map<std::pair<std::string, std::string>, lua_CFunction, std::less<>>;

void collect(lua_State* lua, const char* library, StockFunctions& functions) {
    for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1)) {
        if (lua_type(lua, -2) != LUA_TSTRING || lua_iscfunction(lua, -1) == 0) continue;
        functions[{library, lua_tostring(lua, -2)}] = lua_tocfunction(lua, -1);
    }
}

StockFunctions find_stock_functions() {
    StockFunctions functions;
    lua_State* lua = luaL_newstate();
    assert(lua != nullptr);
    luaL_openlibs(lua);
    lua_pushglobaltable(lua);
    collect(lua, "", functions);
    for (const char* name : {"math", "string", "table", "utf8"}) {
        lua_getglobal(lua, name);
        collect(lua, name, functions);
    }
    lua_pushliteral(lua, "");
    lua_getmetatable(lua, -1);
    collect(lua, "string metatable", functions);
    lua_close(lua);
    return functions;
}

// Pushes a table of these functions. They are copied without upvalues, because none of them needs any.
void push_entries(lua_State* lua, const Entries& entries, int more = 0) {
    lua_createtable(lua, 0, static_cast<int>(entries.size()) + more);
    for (const LibraryFunction& entry : entries) {
        lua_pushcfunction(lua, entry.function);
        lua_setfield(lua, -2, entry.name);
    }
}

void push_math(lua_State* lua) {
    push_entries(lua, math(), 4);
    lua_pushnumber(lua, 3.141592653589793238462643383279502884);
    lua_setfield(lua, -2, "pi");
    lua_pushnumber(lua, HUGE_VAL);
    lua_setfield(lua, -2, "huge");
    lua_pushinteger(lua, LUA_MAXINTEGER);
    lua_setfield(lua, -2, "maxinteger");
    lua_pushinteger(lua, LUA_MININTEGER);
    lua_setfield(lua, -2, "mininteger");
}

void push_utf8(lua_State* lua) {
    push_entries(lua, utf8(), 1);
    lua_pushlstring(lua, "[\0-\x7F\xC2-\xFD][\x80-\xBF]*", 14);
    lua_setfield(lua, -2, "charpattern");
}

// Sets the metatable of strings: methods from the table on top of the stack, which stays there, and arithmetic.
void set_string_metatable(lua_State* lua) {
    lua_pushliteral(lua, "");
    push_entries(lua, string_metamethods(), 2);
    lua_pushvalue(lua, -3);
    lua_setfield(lua, -2, "__index");
    lua_pushboolean(lua, 0);
    lua_setfield(lua, -2, "__metatable");
    lua_setmetatable(lua, -2);
    lua_pop(lua, 1);
}

// Leaves the writable table of string functions on the stack.
void push_string(lua_State* lua) {
    push_entries(lua, string());
    set_string_metatable(lua);
}

struct Library {
    const char* name;
    void (*push)(lua_State*);
};

constexpr Library libraries[] = {
    {"coroutine", [](lua_State* lua) { push_entries(lua, coroutine()); }}, {"math", push_math}, {"string", push_string},
    {"table", [](lua_State* lua) { push_entries(lua, table()); }},         {"utf8", push_utf8},
};

// Adds the library to the globals with raw access, because their metatable may refuse it.
void open(lua_State* lua, const Library& library) {
    luaL_checkstack(lua, 10, nullptr);
    // Lua searches this table for the name of a function that was called without a name.
    luaL_getsubtable(lua, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    library.push(lua);
    lua_pushvalue(lua, -1);
    lua_setfield(lua, -3, library.name);
    lock_table(lua, library.name);
    lua_pushglobaltable(lua);
    lua_pushstring(lua, library.name);
    lua_pushvalue(lua, -3);
    lua_rawset(lua, -3);
    lua_pop(lua, 3);
}

// Runs at the first use of a method of a string.
int find_first_method(lua_State* lua) {
    open_library(lua, "string");  // this also sets the metatable of strings
    lua_settop(lua, 2);
    luaL_getmetafield(lua, 1, "__index");
    lua_insert(lua, 2);
    lua_rawget(lua, 2);
    return 1;
}

}  // namespace

lua_CFunction stock(std::string_view library, std::string_view name) {
    static const StockFunctions functions = find_stock_functions();
    const auto found = functions.find(std::pair(std::string(library), std::string(name)));
    assert(found != functions.end());
    return found->second;
}

Entries stock(std::string_view library, std::initializer_list<const char*> names) {
    Entries entries;
    for (const char* name : names) entries.push_back({name, stock(library, name)});
    return entries;
}

const Entries& utf8() {
    static const Entries entries = stock("utf8", {"char", "codepoint", "codes", "len", "offset"});
    return entries;
}

}  // namespace library

Expected<void> open_sandbox(LuaState& state, Libraries libraries) {
    const auto opened = protect(state.lua(), Budget{10.0}, [libraries](lua_State* lua) {
        luaL_getsubtable(lua, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
        // Lua searches this table too for names of functions. It is not the table of globals, where a script may have
        // functions under other names.
        library::push_entries(lua, library::basic());
        lua_setfield(lua, -2, LUA_GNAME);
        lua_pushglobaltable(lua);
        for (const library::LibraryFunction& entry : library::basic()) {
            lua_pushcfunction(lua, entry.function);
            lua_setfield(lua, -2, entry.name);
        }
        if (libraries == Libraries::when_named) {
            lua_pushcfunction(lua, library::find_first_method);
            library::set_string_metatable(lua);
            return 0;
        }
        for (const library::Library& each : library::libraries) library::open(lua, each);
        return 0;
    });
    if (!opened) return Unexpected(opened.error());
    return {};
}

bool open_library(lua_State* lua, std::string_view name) {
    const auto* found = std::find_if(std::begin(library::libraries), std::end(library::libraries),
                                     [&](const library::Library& each) { return each.name == name; });
    if (found == std::end(library::libraries)) return false;
    library::open(lua, *found);
    return true;
}

Expected<std::unique_ptr<LuaState>> create_sandbox(StateOptions options, Libraries libraries) {
    auto state = LuaState::create(std::move(options));
    if (!state) return state;
    if (auto opened = open_sandbox(**state, libraries); !opened) return Unexpected(opened.error());
    return state;
}

const std::vector<std::string_view>& sandbox_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> list;
        for (const library::LibraryFunction& entry : library::basic()) list.emplace_back(entry.name);
        for (const library::Library& each : library::libraries) list.emplace_back(each.name);
        std::sort(list.begin(), list.end());
        return list;
    }();
    return names;
}

const KnownGlobals& sandbox_globals() {
    static const KnownGlobals known = [] {
        const auto state = create_sandbox();
        assert(state);
        lua_State* const lua = (*state)->lua();
        KnownGlobals globals{.readable = sandbox_names(), .instead = missing_names()};
        for (const library::Library& each : library::libraries) {
            KnownLibrary& library = globals.libraries.emplace_back();
            library.name = each.name;
            lua_getglobal(lua, each.name);
            push_behind_lock(lua, -1);
            for (lua_pushnil(lua); lua_next(lua, -2) != 0; lua_pop(lua, 1)) {
                library.fields.emplace_back(lua_tostring(lua, -2));
            }
            std::sort(library.fields.begin(), library.fields.end());
            lua_settop(lua, 0);
        }
        return globals;
    }();
    return known;
}

}  // namespace nezumi

// Copies the function from one Lua state to the other as bytecode, which never leaves this process.
#include "bindings/console/break_condition.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"

namespace nezumi {
namespace {

constexpr Budget condition_time{0.02};
constexpr char function_key = 0;

int append(lua_State* /*lua*/, const void* bytes, std::size_t size, void* to) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(bytes), size);
    return 0;
}

// Copies nil, a boolean, a number or a string to the other state. Returns false for all other types.
bool push_copy(lua_State* to, lua_State* from, int index) {
    switch (lua_type(from, index)) {
        case LUA_TNIL: lua_pushnil(to); return true;
        case LUA_TBOOLEAN: lua_pushboolean(to, lua_toboolean(from, index)); return true;
        case LUA_TNUMBER:
            if (lua_isinteger(from, index) != 0) return lua_pushinteger(to, lua_tointeger(from, index)), true;
            return lua_pushnumber(to, lua_tonumber(from, index)), true;
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* const text = lua_tolstring(from, index, &size);
            return lua_pushlstring(to, text, size), true;
        }
        default: return false;
    }
}

void push_value(lua_State* lua, const Value& value) {
    if (const auto* truth = value.get_if<bool>()) return lua_pushboolean(lua, *truth ? 1 : 0);
    if (const auto* whole = value.get_if<std::int64_t>()) return lua_pushinteger(lua, *whole);
    if (const auto* number = value.get_if<double>()) return lua_pushnumber(lua, *number);
    const auto* text = value.get_if<std::string>();
    text != nullptr ? static_cast<void>(lua_pushlstring(lua, text->data(), text->size())) : lua_pushnil(lua);
}

}  // namespace

Expected<std::unique_ptr<BreakCondition>> BreakCondition::of_function(lua_State* lua, int index) {
    if (lua_type(lua, index) != LUA_TFUNCTION || lua_iscfunction(lua, index) != 0 || lua_checkstack(lua, 4) == 0)
        return failure("expected a condition, as in function(locals) return locals.d > 3 end");
    const int function = lua_absindex(lua, index);
    std::string code;
    lua_pushvalue(lua, function);
    lua_dump(lua, append, &code, 0);  // fails only for C functions
    lua_pop(lua, 1);
    auto state = create_sandbox();
    if (!state) return Unexpected(state.error());
    const char* wrong = nullptr;  // a variable that can't be copied
    const auto loaded = protect((*state)->lua(), Budget{1}, [&](lua_State* inside) {
        if (luaL_loadbufferx(inside, code.data(), code.size(), "=condition", "b") != LUA_OK) return lua_error(inside);
        for (int i = 1; const char* name = lua_getupvalue(lua, function, i); ++i) {
            if (lua_type(lua, -1) == LUA_TTABLE && name[0] == '_' && std::string_view(name) == "_ENV") {
                lua_pushglobaltable(inside);
            } else if (!push_copy(inside, lua, -1)) {
                wrong = name;
                lua_pushnil(inside);
            }
            lua_pop(lua, 1);
            lua_setupvalue(inside, -2, i);
        }
        lua_rawsetp(inside, LUA_REGISTRYINDEX, &function_key);
        return 0;
    });
    if (!loaded) return failure(loaded.error().message);
    if (wrong != nullptr)
        return failure(
            fmt::format("the condition uses '{}': of the variables outside it, a condition can use only numbers, "
                        "strings and booleans",
                        wrong));
    return std::unique_ptr<BreakCondition>(new BreakCondition(std::move(*state)));
}

Expected<bool> BreakCondition::holds(const std::vector<ErrorFrames::Variable>& variables) {
    lua_State* const lua = state_->lua();
    const auto called = protect(lua, condition_time, [&](lua_State* inside) {
        lua_rawgetp(inside, LUA_REGISTRYINDEX, &function_key);
        lua_createtable(inside, 0, static_cast<int>(variables.size()));
        for (const ErrorFrames::Variable& each : variables) {
            lua_pushlstring(inside, each.name.data(), each.name.size());
            push_value(inside, each.value);
            lua_rawset(inside, -3);
        }
        lua_call(inside, 1, 1);
        return 1;
    });
    if (!called) return failure(called.error().message);
    const bool holds = lua_toboolean(lua, -1) != 0;
    lua_pop(lua, 1);
    return holds;
}

}  // namespace nezumi

// The library `math`: Lua's own functions, and random numbers of the state.
#include <bit>
#include <cstdint>

#include "bindings/lua/sandbox/library.hpp"
#include "bindings/lua/sandbox/state.hpp"

namespace nezumi::library {
namespace {

int random(lua_State* lua) {
    Random& generator = LuaState::of(lua).random();
    lua_Integer low = 1;
    lua_Integer high = 0;
    switch (lua_gettop(lua)) {
        case 0: lua_pushnumber(lua, generator.next_fraction()); return 1;
        case 1:
            high = luaL_checkinteger(lua, 1);
            if (high == 0) {  // all bits
                lua_pushinteger(lua, static_cast<lua_Integer>(generator.next()));
                return 1;
            }
            break;
        case 2:
            low = luaL_checkinteger(lua, 1);
            high = luaL_checkinteger(lua, 2);
            break;
        default: return luaL_error(lua, "wrong number of arguments");
    }
    luaL_argcheck(lua, low <= high, lua_gettop(lua), "interval is empty");
    const auto span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
    lua_pushinteger(lua, static_cast<lua_Integer>(static_cast<std::uint64_t>(low) + generator.next_up_to(span)));
    return 1;
}

// `randomseed` without arguments uses the seed of the state, never a clock.
int seed_random(lua_State* lua) {
    LuaState& state = LuaState::of(lua);
    std::uint64_t seed = state.random_seed();
    std::uint64_t more = 0;
    if (lua_gettop(lua) > 0) {
        int is_integer = 0;
        lua_Integer integer = lua_tointegerx(lua, 1, &is_integer);
        if (is_integer == 0) {  // the bits of any other number are the seed
            integer = std::bit_cast<lua_Integer>(luaL_checknumber(lua, 1));
        }
        seed = static_cast<std::uint64_t>(integer);
        more = static_cast<std::uint64_t>(luaL_optinteger(lua, 2, 0));
    }
    state.random() = Random(seed, more);
    lua_pushinteger(lua, static_cast<lua_Integer>(seed));
    lua_pushinteger(lua, static_cast<lua_Integer>(more));
    return 2;
}

}  // namespace

const Entries& math() {
    static const Entries entries = [] {
        Entries list =
            stock("math", {"abs", "acos", "asin", "atan", "ceil", "cos",  "deg", "exp",       "floor", "fmod", "log",
                           "max", "min",  "modf", "rad",  "sin",  "sqrt", "tan", "tointeger", "type",  "ult"});
        list.insert(list.end(), {{"random", random}, {"randomseed", seed_random}});
        return list;
    }();
    return entries;
}

}  // namespace nezumi::library

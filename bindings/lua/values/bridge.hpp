// The only bridge between C functions that Lua calls and C++ code that may fail. A Lua error is a jump that runs no
// destructors. So a C function has two parts. The first part is C++ code that reads its arguments without raising
// errors and returns an `Expected`. The second part runs when all C++ objects are destroyed: it pushes results, or
// raises the error, whose text the Lua state has stored meanwhile.
#pragma once

#include <lua.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "bindings/lua/sandbox/state.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// The arguments of a call, from the stack index `first` on: 2 for methods. Positions count from 1. Reading raises
/// nothing.
struct Arguments {
    lua_State* lua;
    int first = 1;

    int count() const { return lua_gettop(lua) - first + 1; }
    int index(int position) const { return first + position - 1; }
    /// Whether this argument exists and is not nil.
    bool has(int position) const { return lua_type(lua, index(position)) > LUA_TNIL; }
    /// The type of an argument for messages: "nothing", "string".
    std::string_view kind(int position) const;
    /// The argument, which must be a string and not a number; otherwise the error "expected WHAT, got KIND".
    Expected<std::string> text(int position, std::string_view what) const;
    /// The argument, which must be a number and not a string such as "12"; otherwise the error "expected WHAT, got
    /// KIND".
    Expected<double> number(int position, std::string_view what) const;
    /// The error "FUNCTION: expected at most 2 arguments, got 3: FUNCTION(name, value)" if there are more than `most`;
    /// `usage` is "(name, value)".
    Expected<void> at_most(std::string_view function, int most, std::string_view usage) const;
};

/// Keeps the text of an error until it is raised.
inline void keep_error(lua_State* L, std::string text) { LuaState::of(L).kept_error = std::move(text); }
/// Raises the kept text, with the line of the caller before it.
int raise_kept(lua_State* L);
/// Raises the stored text unchanged, because it already has a location.
int raise_kept_alone(lua_State* L);

/// Runs `body()`, which returns an `Expected<void>`, or an `Expected<int>`: the number of its results on the stack.
/// `body` must not push values that may raise errors (texts, tables). Returns the number of results, or raises the
/// error: at the error's own location if it has one, otherwise at the caller's line.
template <class Body>
int bridge(lua_State* L, Body&& body) {
    enum class End : unsigned char { well, error, error_with_place } end = End::well;
    int results = 0;
    {
        auto done = body();
        if (!done) {
            end = done.error().place.file.empty() ? End::error : End::error_with_place;
            keep_error(L, describe(done.error()));
        } else if constexpr (!std::is_void_v<typename decltype(done)::value_type>) {
            results = *done;
        }
    }
    if (end == End::well) return results;
    return end == End::error ? raise_kept(L) : raise_kept_alone(L);
}

/// Refuses a Lua function at `index` with more parameters than arguments: "its parameter 'dt' is never given: `dt` is a
/// global". Accepts any other value.
Expected<void> check_parameters(lua_State* L, int index, int given);

}  // namespace nezumi

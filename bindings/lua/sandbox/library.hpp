// The parts of the sandbox's library.
#pragma once

#include <initializer_list>
#include <lua.hpp>
#include <string_view>
#include <vector>

namespace nezumi::library {

/// A function of the library and its name.
struct LibraryFunction {
    const char* name;
    lua_CFunction function;
};
using Entries = std::vector<LibraryFunction>;

/// The functions of each library, for scripts. They are Lua's own functions where these are safe.
const Entries& basic();
const Entries& math();
const Entries& string();
const Entries& table();
const Entries& utf8();
const Entries& coroutine();

/// The arithmetic of strings ("10" + 1), for their metatable.
const Entries& string_metamethods();

/// A function of Lua's own library by name. All are found once, by opening the library in a separate state. `library`
/// is empty for basic functions, and "string metatable" for metamethods of strings. An unknown name is a programming
/// error.
lua_CFunction stock(std::string_view library, std::string_view name);
Entries stock(std::string_view library, std::initializer_list<const char*> names);

/// How a function of `table` uses its first argument.
enum TableAccess : unsigned { reads = 1, writes = 2, has_length = 4 };

/// Raises an error unless the value at `index` is a table, or has the metamethods for this `access`.
void check_table(lua_State* lua, int index, unsigned access);

/// The largest number of elements for functions of `table`: more do not fit into the memory of a state.
inline constexpr lua_Integer count_limit = lua_Integer{1} << 24;

}  // namespace nezumi::library

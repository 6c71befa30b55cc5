// The parts that the sandbox's library is put together from.
#pragma once

#include <initializer_list>
#include <lua.hpp>
#include <string_view>
#include <vector>

namespace nezumi::library {

/// A function of the library and what it is called.
struct LibraryFunction {
    const char* name;
    lua_CFunction function;
};
using Entries = std::vector<LibraryFunction>;

/// Each room of the library: the functions that scripts see, stock ones where those are safe as they are.
const Entries& basic();
const Entries& math();
const Entries& string();
const Entries& table();
const Entries& utf8();
const Entries& coroutine();

/// The arithmetic that makes "10" + 1 work, for the metatable of strings.
const Entries& string_metamethods();

/// Functions of Lua's own library by name, found once by opening it in a state of its own. `library` is empty for the
/// basic ones, and "string metatable" for the metamethods of strings. A name that is not there is a mistake of ours.
lua_CFunction stock(std::string_view library, std::string_view name);
Entries stock(std::string_view library, std::initializer_list<const char*> names);

/// What a function of `table` does with its first argument.
enum TableAccess : unsigned { reads = 1, writes = 2, has_length = 4 };

/// Raises an error unless the value at `index` is a table, or behaves like one as far as `access` goes.
void check_table(lua_State* lua, int index, unsigned access);

/// Numbers of elements beyond which the functions of `table` refuse to work: more than fit into the memory of a state.
inline constexpr lua_Integer count_limit = lua_Integer{1} << 24;

}  // namespace nezumi::library

// `table.sort`: stable, and safe with any comparison.
#pragma once

#include <lua.hpp>

namespace nezumi::library {

/// The function `table.sort`. A merge sort: equal elements keep their order, the number of comparisons is limited for
/// every comparison function, and after an error the table is unchanged.
int sort_table(lua_State* lua);

}  // namespace nezumi::library

// Dense matrices for scripts, with Eigen.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// The largest number of rows and columns. With it the longest operation, `solve`, takes less than a millisecond, so no
/// operation needs to check the time limit of the script.
inline constexpr int most_matrix_rows = 64;

/// Pushes the module: a table that makes a matrix from a table of rows when it is called, with `identity(n)` and
/// `zeros(rows, columns)`; behaviors/lib/nezumi/matrix.lua describes it. A matrix is a userdata, so its elements count
/// as memory of the script. Elements are finite; other results are errors. May raise a Lua error (memory).
void push_matrix_module(lua_State* L);

}  // namespace nezumi

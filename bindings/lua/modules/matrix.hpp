// Dense matrices for scripts, with Eigen.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// The largest number of rows and columns. With this limit the longest operation, `solve`, takes less than a
/// millisecond, so no operation needs to check the time limit of the script.
inline constexpr int most_matrix_rows = 64;

/// Pushes the module: a table with the functions `identity(n)` and `zeros(rows, columns)`. A call of the table itself
/// makes a matrix from a table of rows. behaviors/lib/nezumi/matrix.lua describes the module. A matrix is a userdata,
/// so its elements count as memory of the script. All elements are finite: an operation whose result is not finite
/// raises an error. May raise a Lua error (memory).
void push_matrix_module(lua_State* L);

}  // namespace nezumi

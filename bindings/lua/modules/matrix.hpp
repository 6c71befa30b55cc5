// Dense matrices for scripts, on Eigen.
#pragma once

#include <lua.hpp>

namespace nezumi {

/// Rows and columns that a matrix has at most: the longest operation, `solve`, then takes less than a millisecond, so
/// that none of them needs to look at the script's budget.
inline constexpr int most_matrix_rows = 64;

/// Pushes the module: a table that makes a matrix of a table of rows when it is called, with `identity(n)` and
/// `zeros(rows, columns)`; behaviors/lib/nezumi/matrix.lua describes it. A matrix is a userdata, so its elements count
/// against the script's memory. They are finite; what would not be is an error. May raise a Lua error (memory).
void push_matrix_module(lua_State* L);

}  // namespace nezumi

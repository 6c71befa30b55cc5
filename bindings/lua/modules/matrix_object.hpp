// A matrix as a Lua object: a userdata with the sizes, followed by the elements row by row.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <lua.hpp>

namespace nezumi {

using MatrixElements = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

struct MatrixObject {
    int rows, columns;

    /// The elements of row `i`, counted from 0.
    double* row(int i) { return reinterpret_cast<double*>(this + 1) + static_cast<std::ptrdiff_t>(i) * columns; }
    MatrixElements all() { return {row(0), rows, columns}; }
};
static_assert(sizeof(MatrixObject) % sizeof(double) == 0);

/// The matrix at `index`, or null.
MatrixObject* matrix_at(lua_State* L, int index);

/// The matrix that a method was called on. If there is none, raises an error that names the method.
MatrixObject& matrix_self(lua_State* L, const char* method);

/// The name of the value's type for messages. May leave a value on the stack.
const char* kind_at(lua_State* L, int index);

/// The number at `index` as an element. If it is not a finite number, raises an error with row and column, counted from
/// 1.
double element_at(lua_State* L, int index, int row, int column);

/// Pushes a matrix whose elements must then be set.
MatrixObject& push_matrix(lua_State* L, int rows, int columns);

/// Makes the metatables of matrices and of their rows, with these methods and operators. Call this once for each state.
void make_matrix_metatables(lua_State* L, const luaL_Reg* methods, const luaL_Reg* operators);

}  // namespace nezumi

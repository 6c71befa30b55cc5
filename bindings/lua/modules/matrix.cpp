// Operations of matrices. Eigen works on the C++ stack, in copies that need no destructor, because a Lua error would
// skip it.
#include "bindings/lua/modules/matrix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "bindings/lua/modules/matrix_object.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"

namespace nezumi {
namespace {

using Work = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most_matrix_rows, most_matrix_rows>;

constexpr char module_key = 0;  // its address is a key of the registry

int checked(lua_State* L, MatrixObject& result, const char* operation) {
    if (!result.all().allFinite()) return luaL_error(L, "%s: the result is not finite", operation);
    return 1;
}

// Construction

int size_at(lua_State* L, int index, const char* function, const char* what) {
    int is_whole = 0;
    const lua_Integer size = lua_type(L, index) == LUA_TNUMBER ? lua_tointegerx(L, index, &is_whole) : 0;
    if (is_whole == 0 || size < 1 || size > most_matrix_rows)
        luaL_error(L, "%s expected a number of %s from 1 to %d", function, what, most_matrix_rows);
    return static_cast<int>(size);
}

int zeros(lua_State* L) {
    const int rows = size_at(L, 1, "matrix.zeros", "rows");
    const int columns = size_at(L, 2, "matrix.zeros", "columns");
    push_matrix(L, rows, columns).all().setZero();
    return 1;
}

int identity(lua_State* L) {
    const int size = size_at(L, 1, "matrix.identity", "rows");
    push_matrix(L, size, size).all().setIdentity();
    return 1;
}

// Replaces a read-only table at `index`, such as an array of `config`, by the table from which it reads.
void unlock(lua_State* L, int index) {
    if (push_behind_lock(L, index)) lua_replace(L, index);
}

// The length of the table at `index`. Raises an error unless it is 1 to `most_matrix_rows`.
int length_at(lua_State* L, int index, const char* what) {
    const auto length = lua_rawlen(L, index);
    if (length < 1 || length > most_matrix_rows)
        luaL_error(L, "matrix: expected 1 to %d %s, got %I", most_matrix_rows, what, static_cast<LUAI_UACINT>(length));
    return static_cast<int>(length);
}

// matrix { { 4, 1 }, { 2, 3 } }, or a copy of a matrix. Stack: the module, the rows.
int make(lua_State* L) {
    lua_settop(L, 2);
    if (MatrixObject* other = matrix_at(L, 2)) {
        push_matrix(L, other->rows, other->columns).all() = other->all();
        return 1;
    }
    if (lua_type(L, 2) != LUA_TTABLE) return luaL_error(L, "matrix expected a table of rows, got %s", kind_at(L, 2));
    unlock(L, 2);
    const int rows = length_at(L, 2, "rows");
    int columns = 0;
    MatrixObject* made = nullptr;
    for (int i = 1; i <= rows; ++i) {
        lua_rawgeti(L, 2, i);
        const int row = lua_gettop(L);
        if (lua_type(L, row) != LUA_TTABLE)
            return luaL_error(L, "matrix: row %d expected a table of numbers, got %s", i, kind_at(L, row));
        unlock(L, row);
        if (const int length = length_at(L, row, "columns"); i == 1) {
            columns = length;
            made = &push_matrix(L, rows, columns);
            lua_insert(L, 3);
        } else if (length != columns) {
            return luaL_error(L, "matrix: all rows must have the same length: row 1 has %d columns, row %d has %d",
                              columns, i, length);
        }
        lua_settop(L, 4);
        for (int j = 1; j <= columns; ++j) {
            lua_rawgeti(L, 4, j);
            made->row(i - 1)[j - 1] = element_at(L, 5, i, j);
            lua_settop(L, 4);
        }
        lua_settop(L, 3);
    }
    return 1;
}

// Operations

int transpose(lua_State* L) {
    MatrixObject& self = matrix_self(L, "transpose");
    push_matrix(L, self.columns, self.rows).all() = self.all().transpose();
    return 1;
}

// The operands of + and -, which must have equal sizes.
template <class Operation>
int combine(lua_State* L, const char* sign, Operation operation) {
    MatrixObject* left = matrix_at(L, 1);
    MatrixObject* right = matrix_at(L, 2);
    if (left == nullptr || right == nullptr)
        return luaL_error(L, "matrix %s expected two matrices, one is a %s", sign, kind_at(L, left == nullptr ? 1 : 2));
    if (left->rows != right->rows || left->columns != right->columns)
        return luaL_error(L, "%d x %d %s %d x %d: both must have the same size", left->rows, left->columns, sign,
                          right->rows, right->columns);
    MatrixObject& result = push_matrix(L, left->rows, left->columns);
    operation(result.all(), left->all(), right->all());
    return checked(L, result, sign);
}

int add(lua_State* L) {
    return combine(L, "+", [](MatrixElements to, const MatrixElements& a, const MatrixElements& b) { to = a + b; });
}

int subtract(lua_State* L) {
    return combine(L, "-", [](MatrixElements to, const MatrixElements& a, const MatrixElements& b) { to = a - b; });
}

int scale(lua_State* L, MatrixObject& matrix, int factor, const char* sign) {
    if (lua_type(L, factor) != LUA_TNUMBER)
        return luaL_error(L, "matrix %s expected a matrix or a number, got %s", sign, kind_at(L, factor));
    MatrixObject& result = push_matrix(L, matrix.rows, matrix.columns);
    result.all() = matrix.all() * lua_tonumber(L, factor);
    return checked(L, result, sign);
}

int multiply(lua_State* L) {
    MatrixObject* left = matrix_at(L, 1);
    MatrixObject* right = matrix_at(L, 2);
    if (left == nullptr) return scale(L, *right, 1, "*");
    if (right == nullptr) return scale(L, *left, 2, "*");
    if (left->columns != right->rows)
        return luaL_error(
            L, "%d x %d * %d x %d: the columns of the left one and the rows of the right one must be equal in number",
            left->rows, left->columns, right->rows, right->columns);
    MatrixObject& result = push_matrix(L, left->rows, right->columns);
    result.all() = left->all().lazyProduct(right->all());
    return checked(L, result, "*");
}

int negate(lua_State* L) {
    MatrixObject& self = *matrix_at(L, 1);
    push_matrix(L, self.rows, self.columns).all() = -self.all();
    return 1;
}

MatrixObject& square_matrix_self(lua_State* L, const char* method) {
    MatrixObject& self = matrix_self(L, method);
    if (self.rows != self.columns)
        luaL_error(L, "%s expected a square matrix, got %d x %d", method, self.rows, self.columns);
    return self;
}

// Solves `matrix` * `to` = `right` by LU decomposition with full pivoting. False if the matrix is singular, which is
// found by comparing the pivots with the largest one.
bool solve_into(MatrixElements to, const Work& matrix, const Work& right) {
    const Eigen::FullPivLU<Work> decomposed(matrix);
    if (!decomposed.isInvertible()) return false;
    to = decomposed.solve(right);
    return true;
}

int solve(lua_State* L) {
    MatrixObject& self = square_matrix_self(L, "solve");
    MatrixObject* right = matrix_at(L, 2);
    if (right == nullptr) return luaL_error(L, "solve expected a matrix, got %s", kind_at(L, 2));
    if (right->rows != self.rows)
        return luaL_error(L, "solve expected a matrix of %d rows, got %d x %d", self.rows, right->rows, right->columns);
    MatrixObject& result = push_matrix(L, right->rows, right->columns);
    if (!solve_into(result.all(), self.all(), right->all())) return luaL_error(L, "solve: the matrix is singular");
    return checked(L, result, "solve");
}

int inverse(lua_State* L) {
    MatrixObject& self = square_matrix_self(L, "inverse");
    MatrixObject& result = push_matrix(L, self.rows, self.columns);
    if (!solve_into(result.all(), self.all(), Work::Identity(self.rows, self.rows)))
        return luaL_error(L, "inverse: the matrix is singular");
    return checked(L, result, "inverse");
}

bool cholesky_into(MatrixElements to, const Work& matrix) {
    const Eigen::LLT<Work> decomposed(matrix);
    if (decomposed.info() != Eigen::Success) return false;
    to = decomposed.matrixL();
    return true;
}

int cholesky(lua_State* L) {
    constexpr double tolerance = 1e-9;  // largest allowed asymmetry, from rounding, relative to the largest element
    MatrixObject& self = square_matrix_self(L, "cholesky");
    const double largest = self.all().cwiseAbs().maxCoeff();
    if ((self.all() - self.all().transpose()).cwiseAbs().maxCoeff() > tolerance * largest)
        return luaL_error(L, "cholesky: the matrix is not symmetric");
    MatrixObject& result = push_matrix(L, self.rows, self.columns);
    if (!cholesky_into(result.all(), self.all())) return luaL_error(L, "cholesky: the matrix is not positive definite");
    return checked(L, result, "cholesky");
}

int equal(lua_State* L) {
    MatrixObject* left = matrix_at(L, 1);
    MatrixObject* right = matrix_at(L, 2);
    lua_pushboolean(L, left != nullptr && right != nullptr && left->rows == right->rows &&
                           left->columns == right->columns && left->all() == right->all());
    return 1;
}

constexpr luaL_Reg methods[] = {
    {"transpose", transpose}, {"solve", solve}, {"inverse", inverse}, {"cholesky", cholesky}, {nullptr, nullptr}};
constexpr luaL_Reg operators[] = {{"__add", add},    {"__sub", subtract}, {"__mul", multiply},
                                  {"__unm", negate}, {"__eq", equal},     {nullptr, nullptr}};

}  // namespace

void push_matrix_module(lua_State* L) {
    luaL_checkstack(L, 8, nullptr);
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &module_key) != LUA_TNIL) return;
    lua_pop(L, 1);
    make_matrix_metatables(L, methods, operators);
    constexpr luaL_Reg functions[] = {{"identity", identity}, {"zeros", zeros}, {nullptr, nullptr}};
    luaL_newlib(L, functions);
    lock_table(L, "matrix");
    lua_getmetatable(L, -1);
    lua_pushcfunction(L, make);
    lua_setfield(L, -2, "__call");
    lua_pop(L, 1);
    lua_pushvalue(L, -1);
    lua_rawsetp(L, LUA_REGISTRYINDEX, &module_key);
}

}  // namespace nezumi

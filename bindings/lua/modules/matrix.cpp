// Matrices are userdata: their sizes, then their elements row by row. Eigen works on copies of fixed capacity on the
// stack, where a Lua error can skip no destructor.
#include "bindings/lua/modules/matrix.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <new>

#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {
namespace {

using Work = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, most_matrix_rows, most_matrix_rows>;
using Elements = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

struct Matrix {
    int rows, columns;

    double* row(int i) { return reinterpret_cast<double*>(this + 1) + static_cast<std::ptrdiff_t>(i) * columns; }
    Elements all() { return {row(0), rows, columns}; }
};
static_assert(sizeof(Matrix) % sizeof(double) == 0);

// `m[i]`: its user value is the matrix.
struct Row {
    Matrix* matrix;
    int index;
};

// Their addresses are keys of the registry.
constexpr char matrix_key = 0;
constexpr char row_key = 0;
constexpr char module_key = 0;

// A userdata with the metatable of this key, or null.
template <class T>
T* object_at(lua_State* L, int index, const char* key) {
    if (lua_type(L, index) != LUA_TUSERDATA || lua_getmetatable(L, index) == 0) return nullptr;
    lua_rawgetp(L, LUA_REGISTRYINDEX, key);
    const bool is_one = lua_rawequal(L, -1, -2) != 0;
    lua_pop(L, 2);
    return is_one ? static_cast<T*>(lua_touserdata(L, index)) : nullptr;
}

Matrix* matrix_at(lua_State* L, int index) { return object_at<Matrix>(L, index, &matrix_key); }

// What messages call the value at `index`.
const char* kind_at(lua_State* L, int index) {
    return luaL_getmetafield(L, index, "__name") == LUA_TSTRING ? lua_tostring(L, -1) : luaL_typename(L, index);
}

Matrix& self_of(lua_State* L, const char* method) {
    Matrix* self = matrix_at(L, 1);
    if (self == nullptr) luaL_error(L, "%s expected a matrix before the colon: m:%s(...)", method, method);
    return *self;
}

// Pushes a matrix whose elements are to be set.
Matrix& push_matrix(lua_State* L, int rows, int columns) {
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    void* memory = lua_newuserdatauv(L, sizeof(Matrix) + count * sizeof(double), 0);
    auto* matrix = new (memory) Matrix{rows, columns};
    lua_rawgetp(L, LUA_REGISTRYINDEX, &matrix_key);
    lua_setmetatable(L, -2);
    return *matrix;
}

int checked(lua_State* L, Matrix& result, const char* operation) {
    if (!result.all().allFinite()) return luaL_error(L, "%s: the result is not finite", operation);
    return 1;
}

// Making one

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

// Replaces a locked table, as those of `config` are, by the one behind it.
void unlock(lua_State* L, int index) {
    if (push_behind_lock(L, index)) lua_replace(L, index);
}

double element_at(lua_State* L, int index, int row, int column) {
    const double value = lua_type(L, index) == LUA_TNUMBER ? lua_tonumber(L, index) : NAN;
    if (!std::isfinite(value)) {
        const char* got = lua_type(L, index) == LUA_TNUMBER ? push_text(L, index) : kind_at(L, index);
        luaL_error(L, "matrix: row %d, column %d expected a finite number, got %s", row, column, got);
    }
    return value;
}

// The length of the table at `index`.
int length_at(lua_State* L, int index, const char* what) {
    const auto length = lua_rawlen(L, index);
    if (length < 1 || length > most_matrix_rows)
        luaL_error(L, "matrix: expected 1 to %d %s, got %I", most_matrix_rows, what, static_cast<LUAI_UACINT>(length));
    return static_cast<int>(length);
}

// matrix { { 4, 1 }, { 2, 3 } }, or a copy of a matrix. Stack: the module, the rows.
int make(lua_State* L) {
    lua_settop(L, 2);
    if (Matrix* other = matrix_at(L, 2)) {
        push_matrix(L, other->rows, other->columns).all() = other->all();
        return 1;
    }
    if (lua_type(L, 2) != LUA_TTABLE) return luaL_error(L, "matrix expected a table of rows, got %s", kind_at(L, 2));
    unlock(L, 2);
    const int rows = length_at(L, 2, "rows");
    int columns = 0;
    Matrix* made = nullptr;
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
            return luaL_error(L, "matrix: row 1 has %d columns, row %d has %d", columns, i, length);
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

// Calculating

int transpose(lua_State* L) {
    Matrix& self = self_of(L, "transpose");
    push_matrix(L, self.columns, self.rows).all() = self.all().transpose();
    return 1;
}

// The operands of + and -, of equal sizes.
template <class Operation>
int combine(lua_State* L, const char* sign, Operation operation) {
    Matrix* left = matrix_at(L, 1);
    Matrix* right = matrix_at(L, 2);
    if (left == nullptr || right == nullptr)
        return luaL_error(L, "matrix %s expected two matrices, one is a %s", sign, kind_at(L, left == nullptr ? 1 : 2));
    if (left->rows != right->rows || left->columns != right->columns)
        return luaL_error(L, "%d x %d %s %d x %d: both must have the same size", left->rows, left->columns, sign,
                          right->rows, right->columns);
    Matrix& result = push_matrix(L, left->rows, left->columns);
    operation(result.all(), left->all(), right->all());
    return checked(L, result, sign);
}

int add(lua_State* L) {
    return combine(L, "+", [](Elements to, const Elements& a, const Elements& b) { to = a + b; });
}

int subtract(lua_State* L) {
    return combine(L, "-", [](Elements to, const Elements& a, const Elements& b) { to = a - b; });
}

int scale(lua_State* L, Matrix& matrix, int factor, const char* sign) {
    if (lua_type(L, factor) != LUA_TNUMBER)
        return luaL_error(L, "matrix %s expected a matrix or a number, got %s", sign, kind_at(L, factor));
    Matrix& result = push_matrix(L, matrix.rows, matrix.columns);
    result.all() = matrix.all() * lua_tonumber(L, factor);
    return checked(L, result, sign);
}

int multiply(lua_State* L) {
    Matrix* left = matrix_at(L, 1);
    Matrix* right = matrix_at(L, 2);
    if (left == nullptr) return scale(L, *right, 1, "*");
    if (right == nullptr) return scale(L, *left, 2, "*");
    if (left->columns != right->rows)
        return luaL_error(L, "%d x %d * %d x %d: the left one needs as many columns as the right one has rows",
                          left->rows, left->columns, right->rows, right->columns);
    Matrix& result = push_matrix(L, left->rows, right->columns);
    result.all() = left->all().lazyProduct(right->all());
    return checked(L, result, "*");
}

int negate(lua_State* L) {
    Matrix& self = *matrix_at(L, 1);
    push_matrix(L, self.rows, self.columns).all() = -self.all();
    return 1;
}

Matrix& square_self_of(lua_State* L, const char* method) {
    Matrix& self = self_of(L, method);
    if (self.rows != self.columns)
        luaL_error(L, "%s expected a square matrix, got %d x %d", method, self.rows, self.columns);
    return self;
}

// Whether `to` has become what times `matrix` is `right`: by LU with full pivoting, which knows a singular matrix by
// its pivots, relative to the largest.
bool solve_into(Elements to, const Work& matrix, const Work& right) {
    const Eigen::FullPivLU<Work> decomposed(matrix);
    if (!decomposed.isInvertible()) return false;
    to = decomposed.solve(right);
    return true;
}

int solve(lua_State* L) {
    Matrix& self = square_self_of(L, "solve");
    Matrix* right = matrix_at(L, 2);
    if (right == nullptr) return luaL_error(L, "solve expected a matrix, got %s", kind_at(L, 2));
    if (right->rows != self.rows)
        return luaL_error(L, "solve expected a matrix of %d rows, got %d x %d", self.rows, right->rows, right->columns);
    Matrix& result = push_matrix(L, right->rows, right->columns);
    if (!solve_into(result.all(), self.all(), right->all())) return luaL_error(L, "solve: the matrix is singular");
    return checked(L, result, "solve");
}

int inverse(lua_State* L) {
    Matrix& self = square_self_of(L, "inverse");
    Matrix& result = push_matrix(L, self.rows, self.columns);
    if (!solve_into(result.all(), self.all(), Work::Identity(self.rows, self.rows)))
        return luaL_error(L, "inverse: the matrix is singular");
    return checked(L, result, "inverse");
}

bool cholesky_into(Elements to, const Work& matrix) {
    const Eigen::LLT<Work> decomposed(matrix);
    if (decomposed.info() != Eigen::Success) return false;
    to = decomposed.matrixL();
    return true;
}

int cholesky(lua_State* L) {
    constexpr double tolerance = 1e-9;  // of what rounding may leave of symmetry, relative to the largest element
    Matrix& self = square_self_of(L, "cholesky");
    const double largest = self.all().cwiseAbs().maxCoeff();
    if ((self.all() - self.all().transpose()).cwiseAbs().maxCoeff() > tolerance * largest)
        return luaL_error(L, "cholesky: the matrix is not symmetric");
    Matrix& result = push_matrix(L, self.rows, self.columns);
    if (!cholesky_into(result.all(), self.all())) return luaL_error(L, "cholesky: the matrix is not positive definite");
    return checked(L, result, "cholesky");
}

int equal(lua_State* L) {
    Matrix* left = matrix_at(L, 1);
    Matrix* right = matrix_at(L, 2);
    lua_pushboolean(L, left != nullptr && right != nullptr && left->rows == right->rows &&
                           left->columns == right->columns && left->all() == right->all());
    return 1;
}

// As tables and texts

void push_row_table(lua_State* L, Matrix& matrix, int row) {
    lua_createtable(L, matrix.columns, 0);
    for (int j = 0; j < matrix.columns; ++j) {
        lua_pushnumber(L, matrix.row(row)[j]);
        lua_rawseti(L, -2, j + 1);
    }
}

int to_table(lua_State* L) {
    Matrix& self = self_of(L, "to_table");
    lua_createtable(L, self.rows, 0);
    for (int i = 0; i < self.rows; ++i) {
        push_row_table(L, self, i);
        lua_rawseti(L, -2, i + 1);
    }
    return 1;
}

void add_row_text(lua_State* L, luaL_Buffer& text, Matrix& matrix, int row) {
    for (int j = 0; j < matrix.columns; ++j) {
        luaL_addstring(&text, j == 0 ? "{ " : ", ");
        lua_pushnumber(L, matrix.row(row)[j]);
        luaL_tolstring(L, -1, nullptr);
        lua_remove(L, -2);
        luaL_addvalue(&text);
    }
    luaL_addstring(&text, " }");
}

int to_text(lua_State* L) {
    Matrix& self = self_of(L, "tostring");
    luaL_Buffer text;
    luaL_buffinit(L, &text);
    for (int i = 0; i < self.rows; ++i) {
        luaL_addstring(&text, i == 0 ? "{ " : ", ");
        add_row_text(L, text, self, i);
    }
    luaL_addstring(&text, " }");
    luaL_pushresult(&text);
    return 1;
}

int row_to_table(lua_State* L) {
    const Row& row = *object_at<Row>(L, 1, &row_key);
    push_row_table(L, *row.matrix, row.index);
    return 1;
}

int row_to_text(lua_State* L) {
    const Row& row = *object_at<Row>(L, 1, &row_key);
    luaL_Buffer text;
    luaL_buffinit(L, &text);
    add_row_text(L, text, *row.matrix, row.index);
    luaL_pushresult(&text);
    return 1;
}

// Elements

// The key of an access, from 0; raises unless it is one of 1 to `count`.
int index_at(lua_State* L, int index, const Matrix& matrix, const char* what, int count) {
    int is_whole = 0;
    const lua_Integer number = lua_type(L, index) == LUA_TNUMBER ? lua_tointegerx(L, index, &is_whole) : 0;
    if (is_whole == 0 || number < 1 || number > count)
        luaL_error(L, "%s %s of a matrix of %d x %d", what, push_text(L, index), matrix.rows, matrix.columns);
    return static_cast<int>(number - 1);
}

// m[i], m.rows, m.columns, methods. Upvalue: the methods.
int index_matrix(lua_State* L) {
    Matrix& self = *matrix_at(L, 1);
    if (lua_type(L, 2) != LUA_TSTRING) {
        const int index = index_at(L, 2, self, "row", self.rows);
        auto* row = static_cast<Row*>(lua_newuserdatauv(L, sizeof(Row), 1));
        new (row) Row{&self, index};
        lua_pushvalue(L, 1);
        lua_setiuservalue(L, -2, 1);
        lua_rawgetp(L, LUA_REGISTRYINDEX, &row_key);
        lua_setmetatable(L, -2);
        return 1;
    }
    const std::string_view name = string_at(L, 2);
    if (name == "rows" || name == "columns") {
        lua_pushinteger(L, name == "rows" ? self.rows : self.columns);
        return 1;
    }
    lua_pushvalue(L, 2);
    if (lua_rawget(L, lua_upvalueindex(1)) != LUA_TNIL) return 1;
    return bridge(L, [&]() -> Expected<void> {
        return failure(
            "a matrix has no '" + std::string(name) + "'" +
            did_you_mean(name, {"cholesky", "columns", "inverse", "rows", "solve", "to_table", "transpose"}));
    });
}

int set_row(lua_State* L) { return luaL_error(L, "a matrix is set by its elements: m[i][j] = value"); }

int index_row(lua_State* L) {
    const Row& row = *object_at<Row>(L, 1, &row_key);
    lua_pushnumber(L, row.matrix->row(row.index)[index_at(L, 2, *row.matrix, "column", row.matrix->columns)]);
    return 1;
}

int set_element(lua_State* L) {
    const Row& row = *object_at<Row>(L, 1, &row_key);
    const int column = index_at(L, 2, *row.matrix, "column", row.matrix->columns);
    row.matrix->row(row.index)[column] = element_at(L, 3, row.index + 1, column + 1);
    return 0;
}

// Fields that both kinds of objects have: nobody sees their metatables.
void set_metatable(lua_State* L, const char* key, const char* name) {
    lua_pushstring(L, name);
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

void make_metatables(lua_State* L) {
    constexpr luaL_Reg methods[] = {{"transpose", transpose}, {"solve", solve},       {"inverse", inverse},
                                    {"cholesky", cholesky},   {"to_table", to_table}, {nullptr, nullptr}};
    constexpr luaL_Reg of_matrix[] = {{"__newindex", set_row}, {"__add", add},        {"__sub", subtract},
                                      {"__mul", multiply},     {"__unm", negate},     {"__eq", equal},
                                      {"__tostring", to_text}, {"__plain", to_table}, {nullptr, nullptr}};
    constexpr luaL_Reg of_row[] = {{"__index", index_row},
                                   {"__newindex", set_element},
                                   {"__tostring", row_to_text},
                                   {"__plain", row_to_table},
                                   {nullptr, nullptr}};
    luaL_newlib(L, of_matrix);
    luaL_newlib(L, methods);
    lua_pushcclosure(L, index_matrix, 1);
    lua_setfield(L, -2, "__index");
    set_metatable(L, &matrix_key, "matrix");
    luaL_newlib(L, of_row);
    set_metatable(L, &row_key, "row of a matrix");
}

}  // namespace

void push_matrix_module(lua_State* L) {
    luaL_checkstack(L, 8, nullptr);
    if (lua_rawgetp(L, LUA_REGISTRYINDEX, &module_key) != LUA_TNIL) return;
    lua_pop(L, 1);
    make_metatables(L);
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

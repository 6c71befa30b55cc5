// Matrices as seen by Lua: elements, rows as `m[i]`, conversion to text and to tables.
#include "bindings/lua/modules/matrix_object.hpp"

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/text.hpp"
#include "bindings/lua/values/bridge.hpp"

namespace nezumi {
namespace {

// The row `m[i]`. Its user value is the matrix, which so exists as long as the row.
struct Row {
    MatrixObject* matrix;
    int index;
};

// The addresses of these variables are keys of the registry.
constexpr char matrix_key = 0;
constexpr char row_key = 0;

// The userdata at `index`, if its metatable is the one that the registry has for `key`; else null.
template <class T>
T* object_at(lua_State* L, int index, const char* key) {
    if (lua_type(L, index) != LUA_TUSERDATA || lua_getmetatable(L, index) == 0) return nullptr;
    lua_rawgetp(L, LUA_REGISTRYINDEX, key);
    const bool is_one = lua_rawequal(L, -1, -2) != 0;
    lua_pop(L, 2);
    return is_one ? static_cast<T*>(lua_touserdata(L, index)) : nullptr;
}

// Conversion to tables and texts

void push_row_table(lua_State* L, MatrixObject& matrix, int row) {
    lua_createtable(L, matrix.columns, 0);
    for (int j = 0; j < matrix.columns; ++j) {
        lua_pushnumber(L, matrix.row(row)[j]);
        lua_rawseti(L, -2, j + 1);
    }
}

int to_table(lua_State* L) {
    MatrixObject& self = matrix_self(L, "to_table");
    lua_createtable(L, self.rows, 0);
    for (int i = 0; i < self.rows; ++i) {
        push_row_table(L, self, i);
        lua_rawseti(L, -2, i + 1);
    }
    return 1;
}

void add_row_text(lua_State* L, luaL_Buffer& text, MatrixObject& matrix, int row) {
    for (int j = 0; j < matrix.columns; ++j) {
        luaL_addstring(&text, j == 0 ? "{ " : ", ");
        lua_pushnumber(L, matrix.row(row)[j]);
        push_text(L, -1);
        lua_remove(L, -2);
        luaL_addvalue(&text);
    }
    luaL_addstring(&text, " }");
}

int to_text(lua_State* L) {
    MatrixObject& self = matrix_self(L, "tostring");
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

// Converts the Lua index at `index` to an index from 0. Raises an error unless the Lua index is 1 to `count`.
int index_at(lua_State* L, int index, const MatrixObject& matrix, const char* what, int count) {
    int is_whole = 0;
    const lua_Integer number = lua_type(L, index) == LUA_TNUMBER ? lua_tointegerx(L, index, &is_whole) : 0;
    if (is_whole == 0 || number < 1 || number > count)
        luaL_error(L, "there is no %s %s in a matrix of %d x %d", what, push_text(L, index), matrix.rows,
                   matrix.columns);
    return static_cast<int>(number - 1);
}

// m[i], m.rows, m.columns, methods. Upvalue: the methods.
int index_matrix(lua_State* L) {
    MatrixObject& self = *matrix_at(L, 1);
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
        std::vector<std::string_view> names = {"rows", "columns"};
        for (lua_pushnil(L); lua_next(L, lua_upvalueindex(1)) != 0; lua_pop(L, 1)) names.push_back(string_at(L, -2));
        return failure(fmt::format("a matrix has no '{}'{}", shown(name), did_you_mean(name, names)));
    });
}

int set_row(lua_State* L) { return luaL_error(L, "only single elements of a matrix can be set: m[i][j] = value"); }

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

// Completes a metatable of matrices or rows, which scripts can't see, and stores it in the registry.
void set_metatable(lua_State* L, const char* key, const char* name) {
    lua_pushstring(L, name);
    lua_setfield(L, -2, "__name");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_rawsetp(L, LUA_REGISTRYINDEX, key);
}

}  // namespace

MatrixObject* matrix_at(lua_State* L, int index) { return object_at<MatrixObject>(L, index, &matrix_key); }

MatrixObject& matrix_self(lua_State* L, const char* method) {
    MatrixObject* self = matrix_at(L, 1);
    if (self == nullptr) luaL_error(L, "%s expected a matrix before the colon: m:%s(...)", method, method);
    return *self;
}

const char* kind_at(lua_State* L, int index) {
    return luaL_getmetafield(L, index, "__name") == LUA_TSTRING ? lua_tostring(L, -1) : luaL_typename(L, index);
}

double element_at(lua_State* L, int index, int row, int column) {
    const double value = lua_type(L, index) == LUA_TNUMBER ? number_at(L, index) : NAN;
    if (!std::isfinite(value)) {
        const char* got = lua_type(L, index) == LUA_TNUMBER ? push_text(L, index) : kind_at(L, index);
        luaL_error(L, "matrix: row %d, column %d expected a finite number, got %s", row, column, got);
    }
    return value;
}

MatrixObject& push_matrix(lua_State* L, int rows, int columns) {
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    void* memory = lua_newuserdatauv(L, sizeof(MatrixObject) + count * sizeof(double), 0);
    auto* matrix = new (memory) MatrixObject{rows, columns};
    lua_rawgetp(L, LUA_REGISTRYINDEX, &matrix_key);
    lua_setmetatable(L, -2);
    return *matrix;
}

void make_matrix_metatables(lua_State* L, const luaL_Reg* methods, const luaL_Reg* operators) {
    constexpr luaL_Reg of_matrix[] = {
        {"__newindex", set_row}, {"__tostring", to_text}, {"__plain", to_table}, {nullptr, nullptr}};
    constexpr luaL_Reg of_row[] = {{"__index", index_row},
                                   {"__newindex", set_element},
                                   {"__tostring", row_to_text},
                                   {"__plain", row_to_table},
                                   {nullptr, nullptr}};
    luaL_newlib(L, of_matrix);
    luaL_setfuncs(L, operators, 0);
    lua_newtable(L);
    luaL_setfuncs(L, methods, 0);
    lua_pushcfunction(L, to_table);
    lua_setfield(L, -2, "to_table");
    lua_pushcclosure(L, index_matrix, 1);
    lua_setfield(L, -2, "__index");
    set_metatable(L, &matrix_key, "matrix");
    luaL_newlib(L, of_row);
    set_metatable(L, &row_key, "row of a matrix");
}

}  // namespace nezumi

// The comparison of `s:equal`: of Lua values, and of tables entry by entry.
#pragma once

#include <lua.hpp>
#include <string>
#include <unordered_map>
#include <vector>

namespace nezumi {

/// Compares two values: they are equal in Lua, or tables with equal entries. Two tables are compared once: until a
/// difference is found they count as equal, so tables that contain themselves are compared too. The tables that are
/// open are on the Lua stack: the left one, the right one, the present key. Raises no Lua error.
class TableComparison {
public:
    enum class Answer : unsigned char { equal, different, too_deep };

    explicit TableComparison(lua_State* lua) : lua_(lua), base_(lua_gettop(lua)) {}
    ~TableComparison() { lua_settop(lua_, base_); }
    TableComparison(const TableComparison&) = delete;
    TableComparison& operator=(const TableComparison&) = delete;

    Answer compare(int left, int right);
    /// The first difference: "pose.x", or "" for the values themselves.
    std::string where() const;

private:
    int level(std::size_t i) const { return base_ + 1 + 3 * static_cast<int>(i); }
    Answer open();
    Answer step();
    bool join(const void* left, const void* right);
    const void* first_of(const void* table);
    const void* next_of(const void* table) { return equals_.try_emplace(table, table).first->second; }

    lua_State* lua_;
    const int base_;
    std::vector<bool> passed_left_;                        // of each level
    std::unordered_map<const void*, const void*> equals_;  // a table that is taken as equal, or the table itself
};

}  // namespace nezumi

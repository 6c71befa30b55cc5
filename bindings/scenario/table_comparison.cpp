// Compares values for `s:equal`.
#include "bindings/scenario/table_comparison.hpp"

#include <fmt/format.h>

#include "bindings/lua/sandbox/inspect.hpp"
#include "bindings/lua/sandbox/locked_table.hpp"
#include "bindings/lua/sandbox/text.hpp"

namespace nezumi {

TableComparison::Answer TableComparison::compare(int left, int right) {
    lua_pushvalue(lua_, left);
    lua_pushvalue(lua_, right);
    Answer answer = open();
    while (answer == Answer::equal && !passed_left_.empty()) answer = step();
    return answer;
}

std::string TableComparison::where() const {
    constexpr std::size_t longest = 200;
    std::string path;
    for (std::size_t i = 0; i < passed_left_.size(); ++i) {
        if (path.size() > longest) return path + " ...";
        const int key = level(i) + 2;
        const bool is_text = lua_type(lua_, key) == LUA_TSTRING;
        if (is_text && !path.empty()) path += '.';
        path += is_text ? std::string(string_at(lua_, key)) : fmt::format("[{}]", inspect(lua_, key));
    }
    return path;
}

// Compares the two values on top of the stack. Pops them if they are equal; tables stay, for `step` to compare.
TableComparison::Answer TableComparison::open() {
    const int left = lua_gettop(lua_) - 1, right = left + 1;
    bool same = lua_rawequal(lua_, left, right) != 0;
    if (!same) {
        if (lua_type(lua_, left) != LUA_TTABLE || lua_type(lua_, right) != LUA_TTABLE) return Answer::different;
        if (lua_checkstack(lua_, 20) == 0) return Answer::too_deep;
        for (const int at : {left, right}) {
            if (push_behind_lock(lua_, at)) lua_replace(lua_, at);
        }
        same = !join(lua_topointer(lua_, left), lua_topointer(lua_, right));
    }
    if (same) {
        lua_settop(lua_, left - 1);
        return Answer::equal;
    }
    lua_pushnil(lua_);
    passed_left_.push_back(false);
    return Answer::equal;
}

// Compares the next entry of the left table; after them, looks for the next key of the right one in the left one.
TableComparison::Answer TableComparison::step() {
    const int left = level(passed_left_.size() - 1), right = left + 1, key = left + 2;
    if (!passed_left_.back()) {
        if (lua_next(lua_, left) == 0) {
            passed_left_.back() = true;
            lua_pushnil(lua_);
            return Answer::equal;
        }
        lua_pushvalue(lua_, key);
        lua_rawget(lua_, right);
        return open();
    }
    if (lua_next(lua_, right) == 0) {
        passed_left_.pop_back();
        lua_settop(lua_, left - 1);
        return Answer::equal;
    }
    lua_pop(lua_, 1);
    lua_pushvalue(lua_, key);
    const bool has_key = lua_rawget(lua_, left) != LUA_TNIL;
    lua_pop(lua_, 1);
    return has_key ? Answer::equal : Answer::different;
}

// Marks two tables as equal. Returns false if they are marked already, also through others: a and b, then b and c.
bool TableComparison::join(const void* left, const void* right) {
    left = first_of(left);
    right = first_of(right);
    equals_[left] = right;
    return left != right;
}

const void* TableComparison::first_of(const void* table) {
    for (const void* next = next_of(table); next != table; next = next_of(table)) {
        equals_[table] = next_of(next);  // a shorter way, the next time
        table = next;
    }
    return table;
}

}  // namespace nezumi

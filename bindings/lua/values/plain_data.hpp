// Plain data on its way between Lua states: numbers, strings, truth values and tables of them, with their shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/lua/sandbox/call.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {

/// Values outside of any Lua state. A table that is met twice is one table with two references to it, so that shared
/// and cyclic tables keep their shape.
struct PlainData {
    struct TableRef {
        std::size_t index;  ///< in `tables`
        bool operator==(const TableRef&) const = default;
    };
    using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, TableRef>;
    using Table = std::vector<std::pair<Value, Value>>;  ///< ascending: numbers, strings, false, true

    std::vector<Value> values;
    std::vector<Table> tables;

    bool operator==(const PlainData&) const = default;
};

/// What could not be taken along: "state.a.b" and "a function".
struct Dropped {
    std::string path;
    std::string what;

    bool operator==(const Dropped&) const = default;
};

/// Takes copies of the topmost `count` values of the stack, which stay. `names` says what each is called in `dropped`,
/// which collects in a fixed order what is no plain data: functions, userdata, coroutines, keys that are tables,
/// metatables (whose table is taken without it). The depth of tables does not matter. An error only when memory or the
/// budget runs out.
Expected<PlainData> take_plain(lua_State* L, int count, Budget budget, const std::vector<std::string>& names,
                               std::vector<Dropped>& dropped);

/// Visits the numbers, truth values and texts in the table that is the first value: "count", "list[2].deep". Tables
/// that lie too deep, as those within themselves, and what is beyond some thousand entries are left out.
void visit_plain(const PlainData& data, const LeafVisitor& visit);

/// Pushes fresh copies of all values. May raise a Lua error: use it within a protected call.
void push_plain(lua_State* L, const PlainData& data);

}  // namespace nezumi

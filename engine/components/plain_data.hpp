// Plain data of scripts, apart from any script: numbers, strings, truth values and tables of them, with their shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

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

    /// One table that has nothing in it.
    static PlainData empty_table() { return {.values = {TableRef{0}}, .tables = {{}}}; }
};

/// How much a snapshot takes. What is copied between two ticks makes none of them late: some 0.3 us a value.
struct PlainLimit {
    std::size_t values = 4000;                ///< entries of tables
    std::size_t text = std::size_t{1} << 16;  ///< [bytes] of keys and values
};

/// A copy of a table, breadth first, as far as a limit goes: the tables from `whole` on are empty here.
struct PlainSnapshot {
    PlainData data;
    std::size_t whole = 0;
};

}  // namespace nezumi

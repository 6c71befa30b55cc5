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
};

}  // namespace nezumi

// Plain data of scripts, stored outside of the scripts: numbers, strings, booleans and tables of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/values/value.hpp"

namespace nezumi {

/// Refers to one of the tables of plain data.
struct TableRef {
    std::uint64_t index = 0;  ///< in `PlainData::tables`
    bool operator==(const TableRef&) const = default;

    static constexpr std::string_view type_name = "TableRef";
};

/// Values outside of any Lua state. A table that occurs twice is one table with two references, so shared and cyclic
/// tables keep their shape.
struct PlainData {
    using Entry = std::array<Value, 2>;  ///< a key and its value
    using Table = std::vector<Entry>;    ///< ascending: numbers, strings, false, true

    std::vector<Value> values;
    std::vector<Table> tables;

    bool operator==(const PlainData&) const = default;

    /// Data with one value: an empty table.
    static PlainData empty_table() { return {.values = {TableRef{0}}, .tables = {{}}}; }
    /// Adds a table with these entries.
    TableRef add(Table table) {
        tables.push_back(std::move(table));
        return {tables.size() - 1};
    }

    static constexpr std::string_view type_name = "PlainData";
};

/// The possible types of values in plain data, with their names in files: nothing, boolean, int64, float64, text, the
/// sequences of these, and `TableRef`.
struct PlainType {
    std::string_view name;
    const Type* type;
};
std::span<const PlainType> plain_types();

/// Converts a value of any type to plain data, with its tables in `data`: a structure or map becomes a table of its
/// fields, a list a table of its elements, a choice a text. A value without a description becomes nothing.
Value to_plain(const ValueView& value, PlainData& data);

/// Checks data from another program: its table references are valid, and its keys are allowed in Lua tables.
bool is_sound(const PlainData& data);

/// The value with this name in a table; nullptr if there is none.
const Value* find_entry(const PlainData::Table& table, std::string_view name);

/// The limits of a snapshot. Copying between two ticks takes about 0.3 us per value, so a limited snapshot delays no
/// tick.
struct PlainLimit {
    std::size_t values = 4000;                ///< entries of tables
    std::size_t text = std::size_t{1} << 16;  ///< [bytes] of keys and values
};

/// A copy of a table up to a limit, made breadth first. Only the first `whole` tables of the copy have their entries;
/// the others are empty.
struct PlainSnapshot {
    PlainData data;
    std::size_t whole = 0;
};

}  // namespace nezumi

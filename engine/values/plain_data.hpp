// Plain data of scripts, apart from any script: numbers, strings, truth values and tables of them, with their shape.
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

/// Stands for one of the tables of plain data.
struct TableRef {
    std::uint64_t index = 0;  ///< in `PlainData::tables`
    bool operator==(const TableRef&) const = default;

    static constexpr std::string_view type_name = "TableRef";
};

/// Values outside of any Lua state. A table that is met twice is one table with two references to it, so that shared
/// and cyclic tables keep their shape.
struct PlainData {
    using Entry = std::array<Value, 2>;  ///< a key and its value
    using Table = std::vector<Entry>;    ///< ascending: numbers, strings, false, true

    std::vector<Value> values;
    std::vector<Table> tables;

    bool operator==(const PlainData&) const = default;

    /// One table that has nothing in it.
    static PlainData empty_table() { return {.values = {TableRef{0}}, .tables = {{}}}; }
    /// Adds a table with these entries.
    TableRef add(Table table) {
        tables.push_back(std::move(table));
        return {tables.size() - 1};
    }

    static constexpr std::string_view type_name = "PlainData";
};

/// The types that its values have, each with its name in files: nothing, boolean, int64, float64, text, the sequences
/// of these, and `TableRef`.
struct PlainType {
    std::string_view name;
    const Type* type;
};
std::span<const PlainType> plain_types();

/// A value of any type as plain data has it, its tables in `data`: a structure or a map is a table of its fields, a
/// list one of its elements, a choice a text. What describes itself to nobody is nothing.
Value to_plain(const ValueView& value, PlainData& data);

/// Whether data that came from elsewhere can be looked through without a check: its tables are there, and its keys are
/// what a table of Lua can have.
bool is_sound(const PlainData& data);

/// The value of a table's entry of this name; nullptr for none.
const Value* find_entry(const PlainData::Table& table, std::string_view name);

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

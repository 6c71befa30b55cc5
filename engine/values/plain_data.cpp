// What plain data may be made of.
#include "engine/values/plain_data.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

namespace nezumi {

std::span<const PlainType> plain_types() {
    static const std::array all{PlainType{"nothing", &type_of<std::monostate>()},
                                PlainType{"boolean", &type_of<bool>()},
                                PlainType{"integer", &type_of<std::int64_t>()},
                                PlainType{"number", &type_of<double>()},
                                PlainType{"text", &type_of<std::string>()},
                                PlainType{"table", &type_of<TableRef>()},
                                PlainType{"booleans", &type_of<std::vector<bool>>()},
                                PlainType{"integers", &type_of<std::vector<std::int64_t>>()},
                                PlainType{"numbers", &type_of<std::vector<double>>()},
                                PlainType{"texts", &type_of<std::vector<std::string>>()}};
    return all;
}

bool is_sound(const PlainData& data) {
    const auto is_there = [&](const Value& value) {
        const auto* table = value.get_if<TableRef>();
        return table == nullptr || table->index < data.tables.size();
    };
    const auto is_key = [](const Value& key) {
        const auto* number = key.get_if<double>();
        return key.is<bool>() || key.is<std::int64_t>() || key.is<std::string>() ||
               (number != nullptr && !std::isnan(*number));
    };
    return std::all_of(data.values.begin(), data.values.end(), is_there) &&
           std::all_of(data.tables.begin(), data.tables.end(), [&](const PlainData::Table& table) {
               return std::all_of(table.begin(), table.end(), [&](const PlainData::Entry& entry) {
                   return is_key(entry[0]) && is_there(entry[1]);
               });
           });
}

const Value* find_entry(const PlainData::Table& table, std::string_view name) {
    const auto found = std::find_if(table.begin(), table.end(), [&](const PlainData::Entry& entry) {
        const auto* key = entry[0].get_if<std::string>();
        return key != nullptr && *key == name;
    });
    return found != table.end() ? &(*found)[1] : nullptr;
}

}  // namespace nezumi

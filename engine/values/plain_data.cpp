// The allowed types of plain data.
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

Value to_plain(const ValueView& value, PlainData& data) {
    using Kind = Type::Kind;
    PlainData::Table table;
    std::int64_t place = 0;  // in a list, from 1
    const auto add = [&](Value key, const ValueView& element) {
        Value plain = to_plain(element, data);
        if (!plain.is_nothing()) table.push_back({std::move(key), std::move(plain)});
    };
    switch (value.type->kind) {
        case Kind::nothing:
        case Kind::other: return {};
        case Kind::boolean: return value.as<bool>();
        case Kind::enumeration: return value.type->choices[value.choice()];
        case Kind::text: return value.as<std::string>();
        case Kind::octets: {
            const auto& bytes = value.as<Octets>();
            return std::string(bytes.begin(), bytes.end());
        }
        case Kind::any: return to_plain(value.as<Value>(), data);
        case Kind::structure:
            for (const Type::Field& field : value.type->fields) add(field.name, value.field(field));
            std::sort(table.begin(), table.end(), [](const PlainData::Entry& a, const PlainData::Entry& b) {
                return a[0].get<std::string>() < b[0].get<std::string>();
            });
            return data.add(std::move(table));
        case Kind::map:
            for_each_entry(value, [&](const std::string& name, const ValueView& element) { add(name, element); });
            return data.add(std::move(table));
        case Kind::optional: {
            Value held;
            for_each_element(value, [&](const ValueView& element) {
                held = to_plain(element, data);
                return true;
            });
            return held;
        }
        case Kind::array:
        case Kind::sequence:
            for_each_element(value, [&](const ValueView& element) {
                add(++place, element);
                return true;
            });
            return data.add(std::move(table));
        default: break;
    }
    return visit_number(value, [&](auto number) -> Value {
        if (value.type->is_floating()) return static_cast<double>(number);
        return static_cast<std::int64_t>(number);
    });
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

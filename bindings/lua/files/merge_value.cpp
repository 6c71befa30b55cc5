// Merges tables field by field, if both have names.
#include "bindings/lua/files/merge_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace nezumi {
namespace {

// Pairs of alternative fields: one of them in the changes replaces the other one in the base.
constexpr std::pair<std::string_view, std::string_view> alternatives[] = {
    {"table", "response"}, {"size", "radius"}, {"size", "height"}, {"from", "to"}};

bool is_false(const Value& value) {
    const bool* truth = value.get_if<bool>();
    return truth != nullptr && !*truth;
}

bool is_place(const FileTable& table) {
    return !table.fields.empty() && std::all_of(table.fields.begin(), table.fields.end(), [](const FileField& field) {
        return (field.name == "x" || field.name == "y" || field.name == "z") &&
               field.value.get_if<FileTable>() == nullptr;
    });
}

bool is_group(const FileTable* table) { return table != nullptr && table->elements.empty() && !is_place(*table); }

// A sensor of another kind has other fields.
bool changes_kind(const FileTable& base, const FileTable& changes) {
    for (const std::string_view name : {"kind", "shape"}) {
        const Value *before = base.find(name), *after = changes.find(name);
        if (before == nullptr || after == nullptr || before->get_if<std::string>() == nullptr ||
            after->get_if<std::string>() == nullptr)
            continue;
        if (*before->get_if<std::string>() != *after->get_if<std::string>()) return true;
    }
    return false;
}

bool is_table_of_names(const FieldPath& path) {
    return path.size() == 1 && (path[0] == "sensors" || path[0] == "actuators" || path[0] == "ports");
}

// Whether a sensor, actuator or port could be a new one, because it has its kind or type.
bool is_whole(std::string_view group, const Value& value) {
    return value.get_if<FileTable>() == nullptr ||
           value.get_if<FileTable>()->find(group == "ports" ? "type" : "kind") != nullptr;
}

void erase(FileTable& table, std::string_view name) {
    std::erase_if(table.fields, [&](const FileField& field) { return field.name == name; });
}

std::string nearest_field(std::string_view name, const FileTable& table) {
    return did_you_mean(name, table.fields, &FileField::name);
}

// `check` is null for combining two changes; then `false` is kept.
Value merge(FieldCheck* check, const Value& base, const Value& changes, const FieldPath& path) {
    const FileTable *from = base.get_if<FileTable>(), *over = changes.get_if<FileTable>();
    if (!is_group(from) || !is_group(over) || changes_kind(*from, *over)) return changes;
    FileTable merged = *from;
    const auto is_given = [&](std::string_view name) {
        const Value* given = over->find(name);
        return given != nullptr && !is_false(*given);
    };
    for (const FileField& change : over->fields) {
        FieldPath inner = path;
        inner.push_back(change.name);
        const Value* before = from->find(change.name);
        if (check != nullptr && is_false(change.value) && before == nullptr && is_table_of_names(path))
            check->wrong(inner,
                         fmt::format("can't be removed: it does not exist{}", nearest_field(change.name, *from)));
        if (check != nullptr && before == nullptr && is_table_of_names(path) && !is_whole(path[0], change.value)) {
            // If a name is near, this name is misspelt. Otherwise it is new, and the reader reports what is missing.
            if (const std::string near = nearest_field(change.name, *from); !near.empty()) check->unknown(inner, near);
        }
        // If the changes have both, the reader reports that they exclude each other.
        for (const auto& [one, other] : alternatives) {
            if (is_given(one) == is_given(other)) continue;
            if (change.name == one && is_given(one)) erase(merged, other);
            if (change.name == other && is_given(other)) erase(merged, one);
        }
        erase(merged, change.name);
        if (check != nullptr && is_false(change.value) && before != nullptr) continue;
        Value value = before != nullptr ? merge(check, *before, change.value, inner) : change.value;
        const auto place = std::find_if(merged.fields.begin(), merged.fields.end(),
                                        [&](const FileField& field) { return field.name > change.name; });
        merged.fields.insert(place, {change.name, std::move(value)});
    }
    return {std::move(merged)};
}

}  // namespace

Value merge_values(FieldCheck& check, const Value& base, const Value& changes, const FieldPath& path) {
    return merge(&check, base, changes, path);
}

Value combine_changes(const Value& first, const Value& second) { return merge(nullptr, first, second, {}); }

}  // namespace nezumi

// Compares two definitions field by field, in the order of the fields on this host.
#include "bindings/dds/announced_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/messages/message_catalog.hpp"
#include "engine/messages/message_fields.hpp"

namespace nezumi::dds {
namespace {

std::vector<AnnouncedField> fields_of(const MessageType& type) {
    std::vector<AnnouncedField> fields;
    for (MessageField& row : message_fields(type)) {
        if (row.is_structure) continue;
        fields.push_back(
            {std::move(row.path), row.unit.empty() ? row.values : fmt::format("{} [{}]", row.values, row.unit)});
    }
    return fields;
}

const AnnouncedField* find_field(const std::vector<AnnouncedField>& fields, const std::string& path) {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const AnnouncedField& field) { return field.path == path; });
    return found != fields.end() ? &*found : nullptr;
}

std::string name_of(const AnnouncedField& field) {
    return field.path.empty() ? "its value" : fmt::format("field '{}'", shown(field.path));
}

// Names the first of `fields` that `others` lack; "" if there is none. `port`: the port that has the field.
std::string explain_missing(const std::vector<AnnouncedField>& fields, const std::vector<AnnouncedField>& others,
                            const std::string& port) {
    for (const AnnouncedField& field : fields) {
        if (find_field(others, field.path) == nullptr) return fmt::format("only {} has {}", port, name_of(field));
    }
    return "";
}

}  // namespace

std::vector<AnnouncedType> announced_types(const std::vector<const MessageType*>& types) {
    std::vector<AnnouncedType> announced;
    std::size_t count = 0;
    for (const MessageType* type : types) {
        if (type->is_compiled()) continue;
        const std::string name = wire_name(*type);
        const auto is_this = [&](const AnnouncedType& other) { return other.type == name; };
        if (std::any_of(announced.begin(), announced.end(), is_this)) continue;
        std::vector<AnnouncedField> fields = fields_of(*type);
        const bool is_long = std::any_of(fields.begin(), fields.end(), [](const AnnouncedField& field) {
            return field.path.size() > longest_name || field.values.size() > longest_name;
        });
        if (is_long || announced.size() >= most_types || count + fields.size() > most_fields) continue;
        count += fields.size();
        announced.push_back({name, type->name, std::move(fields)});
    }
    return announced;
}

std::string explain_difference(const MessageType& ours, const std::string& port, const AnnouncedType& theirs,
                               const std::string& other_port) {
    if (ours.name != theirs.name) return "";
    const std::vector<AnnouncedField> fields = fields_of(ours);
    for (const AnnouncedField& field : fields) {
        const AnnouncedField* other = find_field(theirs.fields, field.path);
        if (other != nullptr && other->values != field.values)
            return fmt::format("{} is {} in {}, and {} in {}", name_of(field), field.values, port, shown(other->values),
                               other_port);
    }
    if (std::string missing = explain_missing(fields, theirs.fields, port); !missing.empty()) return missing;
    if (std::string missing = explain_missing(theirs.fields, fields, other_port); !missing.empty()) return missing;
    return "its fields have another order";
}

}  // namespace nezumi::dds

// Flattens a message's fields to rows: path, values, unit, meaning.
#include "bindings/lua/stubs/type_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace nezumi {
namespace {

struct Row {
    std::string path, values, unit, doc;
};

std::string values_of(const ValueShape& shape) {
    const std::string_view many = shape.sequence ? "s" : "";
    switch (shape.kind) {
        case ValueShape::Kind::boolean: return shape.sequence ? "array of booleans" : "true or false";
        case ValueShape::Kind::integer:
            return fmt::format("{}integer{} from {} to {}", shape.sequence ? "array of " : "", many, shape.min,
                               shape.max);
        case ValueShape::Kind::number:
            return fmt::format(
                "{}finite number{}{}", shape.sequence ? "array of " : "", many,
                shape.limit < 1e100 ? fmt::format(" from {:.4g} to {:.4g}", -shape.limit, shape.limit) : "");
        case ValueShape::Kind::text: return shape.sequence ? "array of strings" : "string";
        case ValueShape::Kind::octets: return "string of bytes";
        case ValueShape::Kind::structure: break;
    }
    return fmt::format("{}{}", shape.sequence ? "array of " : "", shape.name);
}

void add_rows(std::vector<Row>& rows, const std::string& path, const ValueShape& shape) {
    for (const FieldShape& field : shape.fields) {
        const std::string name = path + std::string(field.name);
        const bool is_structure = field.shape.kind == ValueShape::Kind::structure;
        if (!is_structure || field.shape.sequence || !field.doc.empty()) {
            rows.push_back({name, values_of(field.shape), std::string(field.unit), std::string(field.doc)});
        }
        if (is_structure) add_rows(rows, name + (field.shape.sequence ? "[i]." : "."), field.shape);
    }
}

}  // namespace

std::string type_table(const MessageShape& message) {
    std::string text = fmt::format("{}: {}\n", message.name, message.doc);
    std::vector<Row> rows;
    if (message.shape.kind == ValueShape::Kind::structure) {
        add_rows(rows, "", message.shape);
    } else {
        rows.push_back({"value", values_of(message.shape), "", ""});
    }
    std::array<std::size_t, 3> widths{};
    for (const Row& row : rows) {
        widths = {std::max(widths[0], row.path.size()), std::max(widths[1], row.values.size()),
                  std::max(widths[2], row.unit.size())};
    }
    for (const Row& row : rows) {
        std::string line = fmt::format("  {:{}}  {:{}}  {:{}}  {}", row.path, widths[0], row.values, widths[1],
                                       row.unit, widths[2], row.doc);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string type_table() {
    std::string text;
    for (const MessageShape& message : message_shapes()) text += type_table(message) + "\n";
    return text +
           "Every message carries its stamp tm [s], set by the engine. A single value and a sequence are plain Lua\n"
           "values, the others tables with these fields. In what a script writes a field left out is 0, an unknown "
           "one\n"
           "an error; 3.0 fits an integer, 3.5 does not; NaN and infinity never.\n";
}

}  // namespace nezumi

// Lists the fields of a message as rows: path, values, unit, meaning.
#include "bindings/lua/stubs/type_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace nezumi {
namespace {

struct Row {
    std::string path, values, unit, doc;
};

std::string values_of(const Type& type) {
    const bool many = type.kind == Type::Kind::sequence;
    const Type& single = type.single();
    const std::string_view array = many ? "array of " : "";
    const std::string_view plural = many ? "s" : "";
    if (single.is_integer()) {
        const auto [min, max] = single.integer_range();
        return fmt::format("{}integer{} from {} to {}", array, plural, min, max);
    }
    switch (single.kind) {
        case Type::Kind::boolean: return many ? "array of booleans" : "true or false";
        case Type::Kind::float32: {
            constexpr float limit = std::numeric_limits<float>::max();
            return fmt::format("{}finite number{} from {:.4g} to {:.4g}", array, plural, -limit, limit);
        }
        case Type::Kind::float64: return fmt::format("{}finite number{}", array, plural);
        case Type::Kind::text: return many ? "array of strings" : "string";
        case Type::Kind::octets: return "string of bytes";
        default: return fmt::format("{}{}", array, single.name);
    }
}

void add_rows(std::vector<Row>& rows, const std::string& path, const Type& type) {
    for (const Type::Field& field : type.fields) {
        const std::string name = path + field.name;
        const bool many = field.type->kind == Type::Kind::sequence;
        const Type& single = field.type->single();
        if (many || single.fields.empty() || !field.doc.empty())
            rows.push_back({name, values_of(*field.type), field.unit, field.doc});
        add_rows(rows, name + (many ? "[i]." : "."), single);
    }
}

}  // namespace

std::string type_table(const MessageInfo& message) {
    std::string text = fmt::format("{}: {}\n", message.name, message.doc);
    std::vector<Row> rows;
    add_rows(rows, "", message.payload->single());
    if (rows.empty()) rows.push_back({"value", values_of(*message.payload), "", ""});
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
    for (const MessageInfo& message : message_infos()) text += type_table(message) + "\n";
    return text +
           "Every message carries its stamp tm [s], set by the engine. A single value and a sequence are plain Lua\n"
           "values, the others tables with these fields. In what a script writes a field left out is 0, an unknown "
           "one\n"
           "an error; 3.0 fits an integer, 3.5 does not; NaN and infinity never.\n";
}

}  // namespace nezumi

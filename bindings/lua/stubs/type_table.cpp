// Lists the fields of a message as rows: path, values, unit, meaning.
#include "bindings/lua/stubs/type_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nezumi {
namespace {

struct Row {
    std::string path, values, unit, doc;
};

// `numbers`: which ones its field may have.
std::string values_of(const Type& type, Numbers numbers = Numbers::finite) {
    const bool many = type.element != nullptr;
    const Type& single = many ? *type.element : type;
    if (many && single.element != nullptr) return "array of " + values_of(single, numbers);
    const std::string array = !many ? "" : type.length == 0 ? "array of " : fmt::format("array of {} ", type.length);
    const std::string_view plural = many ? "s" : "";
    if (single.is_integer()) {
        const auto [min, max] = single.integer_range();
        return fmt::format("{}integer{} from {} to {}", array, plural, min, max);
    }
    const bool any = numbers == Numbers::any;
    const std::string number = fmt::format("{}{}number{}", array, any ? "" : "finite ", plural);
    const std::string_view others = any ? ", also inf and nan" : "";
    switch (single.kind) {
        case Type::Kind::boolean: return many ? "array of booleans" : "true or false";
        case Type::Kind::float32: {
            constexpr float limit = std::numeric_limits<float>::max();
            return fmt::format("{} from {:.4g} to {:.4g}{}", number, -limit, limit, others);
        }
        case Type::Kind::float64: return fmt::format("{}{}", number, others);
        case Type::Kind::text: return many ? "array of strings" : "string";
        case Type::Kind::octets: return "string of bytes";
        case Type::Kind::enumeration: return array + fmt::format("{}", fmt::join(single.choices, " | "));
        default: return fmt::format("{}{}", array, single.name);
    }
}

void add_rows(std::vector<Row>& rows, const std::string& path, const Type& type) {
    for (const Type::Field& field : type.fields) {
        const std::string name = path + field.name;
        const bool many = field.type->element != nullptr;
        const Type& single = many ? *field.type->element : *field.type;
        if (many || single.fields.empty() || !field.doc.empty()) {
            const std::string limits = field.limits != nullptr ? limits_text(*field.limits) : "";
            rows.push_back({name, values_of(*field.type, field.numbers) + limits, field.unit, field.doc});
        }
        add_rows(rows, name + (many ? "[i]." : "."), single);
    }
}

}  // namespace

std::string limits_text(const FieldLimits& limits) {
    std::string text;
    if (std::isfinite(limits.min)) text += fmt::format(", from {}", limits.min);
    if (std::isfinite(limits.max)) text += fmt::format("{} up to {}", text.empty() ? "," : "", limits.max);
    if (limits.length != FieldLimits{}.length) text += fmt::format(", up to {} long", limits.length);
    return text;
}

std::string type_table(const MessageType& message) {
    std::string text = fmt::format("{}: {}\n", message.name, message.doc);
    if (!message.file.empty()) text += fmt::format("  defined in {}\n", message.file);
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

std::string type_table(const std::vector<const MessageType*>& defined) {
    std::string text;
    for (const MessageType& message : compiled_message_types()) text += type_table(message) + "\n";
    for (const MessageType* message : defined) text += type_table(*message) + "\n";
    return text +
           "Every message carries its stamp tm [s], set by the engine. A single value and a sequence are plain Lua\n"
           "values, the others tables with these fields. In what a script writes a field left out is 0, an unknown "
           "one\n"
           "an error; 3.0 fits an integer, 3.5 does not; NaN and infinity never.\n";
}

}  // namespace nezumi

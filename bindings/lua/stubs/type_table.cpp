// Lists the fields of a message as rows: path, values, unit, meaning.
#include "bindings/lua/stubs/type_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/messages/message_fields.hpp"

namespace nezumi {

std::string type_table(const MessageType& message) {
    std::string text = fmt::format("{}: {}\n", message.name, message.doc);
    if (!message.file.empty()) text += fmt::format("  defined in {}\n", message.file);
    std::vector<MessageField> rows = message_fields(message);
    std::erase_if(rows, [](const MessageField& row) { return row.is_structure && row.doc.empty(); });
    if (rows.front().path.empty()) rows.front().path = "value";
    std::array<std::size_t, 3> widths{};
    for (const MessageField& row : rows) {
        widths = {std::max(widths[0], row.path.size()), std::max(widths[1], row.values.size()),
                  std::max(widths[2], row.unit.size())};
    }
    for (const MessageField& row : rows) {
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
           "values, the others tables with these fields. In a value that a script writes, a missing field is 0 and an\n"
           "unknown one is an error; 3.0 fits an integer, 3.5 does not; NaN and infinity never.\n";
}

}  // namespace nezumi

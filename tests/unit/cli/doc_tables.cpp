// Writes the tables, and inserts them into a page.
#include "tests/unit/cli/doc_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/tree/member.hpp"

namespace nezumi {
namespace {

// A cell must not contain a bar. A class of editors is shown as a table with its own fields, an alias as a value.
std::string cell(std::string text) {
    if (text == "ParameterValue[]") return "{ VALUE, ... }";
    constexpr std::string_view suffix = "Fields";
    if (const std::size_t end = text.find(suffix); end != std::string::npos) {
        const std::size_t before = text.find_last_of("| ", end);
        const std::size_t begin = before == std::string::npos ? 0 : before + 1;
        text.replace(begin, end + suffix.size() - begin, "{ ... }");
    }
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 4) text.replace(at, 1, " or ");
    return text;
}

std::string default_of(const FieldRow& row) {
    if (row.required) return "required";
    const bool is_value = row.fallback.find_first_of("`0123456789") != std::string::npos ||
                          row.fallback.starts_with('"') || row.fallback == "true" || row.fallback == "false";
    const bool is_quoted = row.fallback.find_first_of("` ") != std::string::npos && !row.fallback.starts_with('{');
    return is_value && !is_quoted ? "`" + row.fallback + "`" : row.fallback;
}

std::string field_table(const RecordShape& record) {
    const bool has_kinds =
        std::any_of(record.rows.begin(), record.rows.end(), [](const FieldRow& row) { return !row.kinds.empty(); });
    std::string text = has_kinds ? "| of | field | value | default | meaning |\n|---|---|---|---|---|\n"
                                 : "| field | value | default | meaning |\n|---|---|---|---|\n";
    for (const FieldRow& row : record.rows) {
        if (has_kinds) text += fmt::format("| {} ", row.kinds.empty() ? "all" : row.kinds);
        const std::string value = cell(row.values.empty() ? row.type : row.values);
        const std::string unit = row.unit.empty() ? "" : fmt::format(" [{}]", row.unit);
        text += fmt::format("| `{}` | {}{} | {} | {} |\n", row.name, value, unit, default_of(row), row.doc);
    }
    return text;
}

// `owner` is "X" or "port".
std::string member_table(std::span<const MemberInfo> members, std::string_view owner) {
    std::string text = fmt::format("| `{}.` | |\n|---|---|\n", owner);
    for (const MemberInfo& member : members) {
        const std::string name = fmt::format("{}{}{}", member.called ? ":" : "", member.name, member.usage);
        text += fmt::format("| `{}` | {}{} |\n", name, member.robot ? "of robots: " : "", member.doc);
    }
    return text;
}

}  // namespace

Expected<std::string> with_tables(std::string_view page, std::string_view kind,
                                  const std::function<Expected<std::string>(std::string_view name)>& table) {
    const std::string opening = fmt::format("<!-- {}: ", kind);
    constexpr std::string_view closing = "<!-- end -->";
    std::string text;
    for (;;) {
        const std::size_t begin = page.find(opening);
        if (begin == std::string_view::npos) return text + std::string(page);
        const std::size_t end_of_line = page.find('\n', begin), end = page.find(closing, begin);
        if (end == std::string_view::npos) return failure(fmt::format("a marker for {} has no end", kind));
        const std::size_t name = begin + opening.size();
        const auto made = table(page.substr(name, page.find(" -->", name) - name));
        if (!made) return Unexpected(made.error());
        text += page.substr(0, end_of_line + 1);
        text += *made;
        text += closing;
        page.remove_prefix(end + closing.size());
    }
}

Expected<std::string> with_field_tables(std::string_view page, const std::vector<RecordShape>& records) {
    return with_tables(page, "fields", [&](std::string_view name) -> Expected<std::string> {
        const auto record = std::find_if(records.begin(), records.end(), [&](const auto& r) { return r.name == name; });
        if (record == records.end()) return failure(fmt::format("there are no fields of '{}'", name));
        return field_table(*record);
    });
}

Expected<std::string> with_member_tables(std::string_view page) {
    return with_tables(page, "members", [](std::string_view name) -> Expected<std::string> {
        if (name == "component") return member_table(component_members(), "X");
        if (name == "port") return member_table(port_members(), "port");
        return failure(fmt::format("there are no members of '{}'", name));
    });
}

}  // namespace nezumi

// Splits CSV rows. Quotes are special only at the beginning of a field.
#include "engine/base/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>

#include "engine/base/list.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/trimmed.hpp"

namespace nezumi {
namespace {

// The largest accepted magnitude. Values of robots are much smaller; larger ones make the physics unstable.
constexpr double largest = 1e6;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Returns the end of the field that begins at `at`: the comma after it, or the end of the row. npos if a quote is not
// closed.
std::size_t end_of_field(std::string_view row, std::size_t at) {
    while (at < row.size() && is_blank(row[at])) ++at;
    while (at < row.size() && row[at] == '"') {  // two quotes within quotes mean one
        at = row.find('"', at + 1);
        if (at == std::string_view::npos) return at;
        ++at;
    }
    return std::min(row.find(',', at), row.size());
}

// Adds the fields of a row. If a quote is not closed, adds only the fields before it and returns false.
bool split(std::string_view row, std::vector<std::string_view>& fields) {
    for (std::size_t begin = 0;;) {
        const std::size_t end = end_of_field(row, begin);
        if (end == std::string_view::npos) return false;
        fields.push_back(row.substr(begin, end - begin));
        if (end == row.size()) return true;
        begin = end + 1;
    }
}

std::string list_of(const std::vector<CsvColumn>& columns) {
    std::string list;
    for (const CsvColumn& column : columns) list += (list.empty() ? "" : ",") + std::string(column.name);
    return list;
}

// Returns the column of each field of the header row.
Expected<std::vector<std::size_t>> read_header(const std::vector<std::string>& fields,
                                               const std::vector<CsvColumn>& columns, const Place& place) {
    const std::string expected = "expected a header row " + list_of(columns);
    if (signed_finite_in(fields.front()))
        return failure(fmt::format("{}, got the numbers '{}, ...'", expected, shown(fields.front())), place);
    if (fields.size() == 1 && fields.front().find_first_of(";\t") != std::string::npos) {
        return failure(expected + ", got columns that are not separated by commas", place);
    }
    std::vector<std::string_view> names;
    names.reserve(columns.size());
    for (const CsvColumn& column : columns) names.push_back(column.name);
    std::vector<std::size_t> order;
    for (const std::string& field : fields) {
        const auto found = std::find(names.begin(), names.end(), field);
        if (found == names.end()) {
            return failure(fmt::format("unknown column '{}'{}; {}", shown(field), did_you_mean(field, names), expected),
                           place);
        }
        const auto index = static_cast<std::size_t>(found - names.begin());
        if (contains(order, index)) {
            return failure(fmt::format("column '{}' occurs twice", field), place);
        }
        order.push_back(index);
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (!contains(order, i)) {
            return failure(fmt::format("column '{}' is missing; {}", columns[i].name, expected), place);
        }
    }
    return order;
}

}  // namespace

Expected<double> csv_number(const std::string& field, const CsvColumn& column, const Place& place) {
    const auto value = signed_finite_in(field);
    const bool allowed = value && (column.range == CsvColumn::Range::any || *value > 0 ||
                                   (*value == 0 && column.range == CsvColumn::Range::not_negative));
    if (!allowed) {
        const std::string_view expected = column.range == CsvColumn::Range::any            ? "a number"
                                          : column.range == CsvColumn::Range::not_negative ? "a number from 0 on"
                                                                                           : "a positive number";
        return failure(fmt::format("column '{}': expected {}, got '{}'", column.name, expected, shown(field)), place);
    }
    if (std::abs(*value) > largest) {
        return failure(fmt::format("column '{}': expected {}, got '{}'", column.name, number_within(largest, *value),
                                   shown(field)),
                       place);
    }
    return *value;
}

std::string csv_quoted(std::string_view text) {
    std::string all = "\"";
    for (const char c : text) all.append(c == '"' ? 2 : 1, c);
    return all + '"';
}

std::string csv_field(std::string_view text) {
    const bool is_plain = text.find_first_of(",\"\r\n") == std::string_view::npos && trimmed(text) == text;
    return is_plain ? std::string(text) : csv_quoted(text);
}

std::optional<std::vector<std::string_view>> split_csv_row(std::string_view row) {
    std::vector<std::string_view> fields;
    if (!split(row, fields)) return std::nullopt;
    return fields;
}

std::vector<std::string_view> closed_csv_fields(std::string_view row) {
    std::vector<std::string_view> fields;
    split(row, fields);
    return fields;
}

std::string csv_text(std::string_view field) {
    field = trimmed(field);
    std::string text;
    for (bool again = false; field.starts_with('"'); again = true) {
        if (again) text += '"';
        const std::size_t quote = std::min(field.find('"', 1), field.size() - 1);
        text += field.substr(1, quote - 1);
        field.remove_prefix(quote + 1);
    }
    return text.append(trimmed(field));
}

bool read_csv_row(std::istream& in, std::string& row) {
    if (!std::getline(in, row)) return false;
    for (std::string more; !split_csv_row(row) && std::getline(in, more);) row.append("\n").append(more);
    return true;
}

std::optional<std::size_t> end_of_csv_row(std::string_view text, std::size_t from) {
    for (std::size_t end = text.find('\n', from); end != std::string_view::npos; end = text.find('\n', end + 1)) {
        if (split_csv_row(text.substr(from, end - from))) return end + 1;
    }
    return std::nullopt;
}

Expected<std::vector<CsvRow>> read_csv(std::string_view text, const std::string& file,
                                       const std::vector<CsvColumn>& columns) {
    if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
    std::optional<std::vector<std::size_t>> order;
    std::vector<CsvRow> rows;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#') continue;

        const Place place{file, number};
        const auto written = split_csv_row(line);
        if (!written) return failure("a quote is not closed", place);
        std::vector<std::string> fields;
        for (const std::string_view field : *written) fields.emplace_back(trimmed(csv_text(field)));
        // Spreadsheets add empty fields at the end of rows.
        while (fields.size() > (order ? order->size() : 0) && fields.back().empty()) fields.pop_back();
        if (std::all_of(fields.begin(), fields.end(), [](const std::string& field) { return field.empty(); })) continue;
        if (!order) {
            auto header = read_header(fields, columns, place);
            if (!header) return Unexpected(header.error());
            order = std::move(*header);
            continue;
        }
        if (fields.size() != order->size()) {
            return failure(
                fmt::format("expected {} values ({}), got {}", order->size(), list_of(columns), fields.size()), place);
        }
        CsvRow row{std::vector<double>(columns.size()), number};
        for (std::size_t i = 0; i < fields.size(); ++i) {
            const std::size_t column = (*order)[i];
            const auto value = csv_number((fields)[i], columns[column], place);
            if (!value) return Unexpected(value.error());
            row.values[column] = *value;
        }
        rows.push_back(std::move(row));
    }
    if (!order) return failure(fmt::format("is empty: expected a header row {}", list_of(columns)), {file});
    return rows;
}

}  // namespace nezumi

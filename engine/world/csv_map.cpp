// Reads maps in CSV files: each row is a fixed box.
#include "engine/world/csv_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

#include "engine/base/csv.hpp"

namespace nezumi {
namespace {

constexpr std::array<CsvColumn, 7> columns{{{"x"},
                                            {"y"},
                                            {"z"},
                                            {"lx", CsvColumn::Range::positive},
                                            {"ly", CsvColumn::Range::positive},
                                            {"lz", CsvColumn::Range::positive},
                                            {"yaw"}}};

// The fields of a row, up to an unclosed quote.
std::vector<std::string> fields_of(std::string_view row) {
    std::vector<std::string> fields;
    for (const std::string_view field : closed_csv_fields(row)) fields.push_back(csv_text(field));
    return fields;
}

// The index of the column for each number of a box, in the order of `columns`.
using Order = std::array<std::size_t, columns.size()>;
constexpr Order usual_order{0, 1, 2, 3, 4, 5, 6};

Order order_of(const std::vector<std::string>& header) {
    Order order{};
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto is_named = [&](std::string field) {
            std::transform(field.begin(), field.end(), field.begin(), [](unsigned char c) { return std::tolower(c); });
            return field == columns[i].name;
        };
        const auto found = std::find_if(header.begin(), header.end(), is_named);
        if (found == header.end()) return usual_order;
        order[i] = static_cast<std::size_t>(found - header.begin());
    }
    return order;
}

std::size_t least_fields(const Order& order) { return *std::max_element(order.begin(), order.end()) + 1; }

// An error for rows whose columns are separated by another character than a comma; otherwise "".
std::string other_separator(std::string_view row) {
    for (const auto& [separator, name] : {std::pair{';', "semicolons"}, {'\t', "tabs"}}) {
        if (std::count(row.begin(), row.end(), separator) >= static_cast<int>(columns.size()) - 1)
            return fmt::format("columns that are separated by {}: separate them by commas", name);
    }
    return "";
}

Expected<BoxSpec> read_row(const std::vector<std::string>& fields, const Order& order, const Place& place) {
    std::array<double, columns.size()> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
        const auto number = csv_number(fields[order[i]], columns[i], place);
        if (!number) return Unexpected(number.error());
        v[i] = *number;
    }
    return BoxSpec{.at = {v[0], v[1], v[2]}, .size = {v[3], v[4], v[5]}, .yaw = v[6], .place = place};
}

// Whether an unclosed quote hides a row that would be a box without quotes.
bool hides_box(std::string_view row, const Order& order, const Place& place) {
    if (split_csv_row(row)) return false;
    std::string bare(row);
    std::erase(bare, '"');
    const auto fields = fields_of(bare);
    return fields.size() >= least_fields(order) && read_row(fields, order, place).has_value();
}

Unexpected no_box(const std::string& found, const Place& place) {
    return failure(fmt::format("expected rows x,y,z,lx,ly,lz,yaw, got {}", found), place);
}

}  // namespace

Expected<CsvMap> read_map(std::string_view text, const std::string& file) {
    if (text.empty()) return failure("is empty: expected a header line, then rows x,y,z,lx,ly,lz,yaw", {file});
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    CsvMap map;
    Order order = usual_order;
    std::optional<Unexpected> first_short;
    const char line_end = text.find('\n') == text.npos ? '\r' : '\n';
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find(line_end), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const Place place{file, number};
        const auto fields = fields_of(line);
        if (number == 1) {
            order = order_of(fields);
            map.header_is_numbers = fields.size() >= columns.size() && read_row(fields, order, place).has_value();
            continue;
        }
        const auto is_empty = [](const std::string& field) { return field.empty(); };
        const bool is_blank = std::all_of(fields.begin(), fields.end(), is_empty);
        const bool is_comment = line.substr(std::min(line.find_first_not_of(" \t"), line.size())).starts_with('#');
        const bool is_short = fields.size() < least_fields(order);
        if (is_short && !is_comment && hides_box(line, order, place)) return failure("a quote is not closed", place);
        if (is_short && !is_comment && !is_blank && !first_short) {
            const std::string separator = other_separator(line);
            const std::string count = fmt::format("{} column{}", fields.size(), fields.size() == 1 ? "" : "s");
            first_short = no_box(separator.empty() ? count : separator, place);
        }
        if (is_blank || is_comment || is_short) {
            ++map.skipped;
            continue;
        }
        auto box = read_row(fields, order, place);
        if (!box) {
            // A row with decimal commas can have enough columns, so its separator is checked here too.
            const std::string separator = other_separator(line);
            return separator.empty() ? Unexpected(box.error()) : no_box(separator, place);
        }
        map.boxes.push_back(std::move(*box));
    }
    if (map.boxes.empty() && first_short) return *first_short;
    if (map.boxes.empty()) {
        return no_box(
            map.header_is_numbers ? "none: the first line, which reads like a box, is skipped as a header" : "none",
            {file});
    }
    return map;
}

std::string describe(const CsvMap& map, const std::string& file) {
    std::string text = fmt::format("{}: {} box{}", file, map.boxes.size(), map.boxes.size() == 1 ? "" : "es");
    if (map.skipped > 0)
        text += fmt::format(", {} skipped", map.skipped == 1 ? "1 line that is not a box"
                                                             : fmt::format("{} lines that are not boxes", map.skipped));
    if (map.header_is_numbers) text += "; its first line, which is skipped as a header, reads like a box";
    return text;
}

}  // namespace nezumi

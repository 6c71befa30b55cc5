// Maps in CSV files: one fixed box a row.
#include "engine/world/csv_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

// The texts of a row, up to a quote that is not closed.
std::vector<std::string> fields_of(std::string_view row) {
    std::vector<std::string> fields;
    for (const std::string_view field : closed_csv_fields(row)) fields.push_back(csv_text(field));
    return fields;
}

Expected<BoxSpec> read_row(const std::vector<std::string>& fields, const Place& place) {
    std::array<double, 7> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
        const auto number = csv_number(fields[i], columns[i], place);
        if (!number) return Unexpected(number.error());
        v[i] = *number;
    }
    return BoxSpec{.at = {v[0], v[1], v[2]}, .size = {v[3], v[4], v[5]}, .yaw = v[6], .place = place};
}

// Whether a row would be a box if it had no quotes, and is none as one of them is not closed.
bool hides_box(std::string_view row, const Place& place) {
    if (split_csv_row(row)) return false;
    std::string bare(row);
    std::erase(bare, '"');
    const auto fields = fields_of(bare);
    return fields.size() >= columns.size() && read_row(fields, place).has_value();
}

}  // namespace

Expected<CsvMap> read_map(std::string_view text, const std::string& file) {
    if (text.empty()) return failure("is empty: expected a header line, then rows x,y,z,lx,ly,lz,yaw", {file});
    CsvMap map;
    const char line_end = text.find('\n') == text.npos ? '\r' : '\n';
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find(line_end), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const Place place{file, number};
        const auto fields = fields_of(line);
        if (number == 1) {
            map.header_is_numbers = fields.size() >= columns.size() && read_row(fields, place).has_value();
            continue;
        }
        const auto is_empty = [](const std::string& field) { return field.empty(); };
        const bool is_blank = std::all_of(fields.begin(), fields.end(), is_empty);
        const bool is_comment = line.substr(std::min(line.find_first_not_of(" \t"), line.size())).starts_with('#');
        const bool is_short = fields.size() < columns.size();
        if (is_short && !is_comment && hides_box(line, place)) return failure("a quote is not closed", place);
        if (is_blank || is_comment || is_short) {
            ++map.skipped;
            continue;
        }
        auto box = read_row(fields, place);
        if (!box) return Unexpected(box.error());
        map.boxes.push_back(std::move(*box));
    }
    return map;
}

std::string describe(const CsvMap& map, const std::string& file) {
    std::string text = fmt::format("{}: {} box{}", file, map.boxes.size(), map.boxes.size() == 1 ? "" : "es");
    if (map.skipped > 0)
        text += fmt::format(", {} skipped", map.skipped == 1 ? "1 line that is no box"
                                                             : fmt::format("{} lines that are no box", map.skipped));
    if (map.header_is_numbers) text += "; its first line, which is skipped as a header, reads like a box";
    return text;
}

}  // namespace nezumi

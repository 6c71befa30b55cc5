// Maps in CSV files: one fixed box a row.
#include "engine/base/csv.hpp"
#include "engine/world/arena_spec.hpp"

namespace nezumi {

Expected<std::vector<BoxSpec>> read_csv_map(std::string_view text, const std::string& file) {
    using Range = CsvColumn::Range;
    const auto rows = read_csv(text, file,
                               {{"x", Range::any},
                                {"y", Range::any},
                                {"z", Range::any},
                                {"lx", Range::positive},
                                {"ly", Range::positive},
                                {"lz", Range::positive},
                                {"yaw", Range::any}});
    if (!rows) return Unexpected(rows.error());
    std::vector<BoxSpec> boxes;
    boxes.reserve(rows->size());
    for (const CsvRow& row : *rows) {
        const std::vector<double>& v = row.values;
        BoxSpec box;
        box.at = {v[0], v[1], v[2]};
        box.size = {v[3], v[4], v[5]};
        box.yaw = v[6];
        box.place = {file, row.line};
        boxes.push_back(std::move(box));
    }
    return boxes;
}

}  // namespace nezumi

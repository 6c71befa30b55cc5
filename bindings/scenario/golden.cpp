// Compares cells by the names of their columns, so the order of columns does not matter.
#include "bindings/scenario/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "engine/base/csv.hpp"
#include "engine/base/number_in.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/project/project.hpp"

namespace nezumi {
namespace {

constexpr std::size_t time_column = ~std::size_t{0};

using RowTexts = std::vector<std::string>;

// The rows with each cell as it is written, so that a text is never read as a number.
std::vector<RowTexts> read_rows(const std::string& csv) {
    std::istringstream in(csv);
    std::vector<RowTexts> rows;
    for (std::string row; read_csv_row(in, row);) {
        if (row.ends_with('\r')) row.pop_back();
        const auto fields = split_csv_row(row);
        if (fields && !row.empty()) rows.emplace_back(fields->begin(), fields->end());
    }
    return rows;
}

std::string shown_cell(const std::string& text) { return text.empty() ? "nothing" : shown(text); }

}  // namespace

void Golden::add(double now) {
    table_.read([&](const std::vector<std::string>& cells) { rows_.push_back({fmt::format("{:.9g}", now), cells}); });
}

std::string Golden::text() const {
    std::string out = table_.header() + "\n";
    const std::vector<std::size_t> order = table_.order();
    for (const Row& row : rows_) out += TraceTable::row(row.time, order, row.cells) + "\n";
    return out;
}

Expected<void> Golden::compare(const std::string& csv) const {
    const auto golden = read_rows(csv);
    if (golden.empty()) return failure("the file is empty");
    const RowTexts& names = golden.front();
    for (const std::size_t id : table_.order()) {
        const std::string& name = table_.names()[id];
        if (std::none_of(names.begin(), names.end(), [&](const std::string& each) { return csv_text(each) == name; }))
            return failure(fmt::format("the file has no column '{}'", name));
    }
    std::vector<std::size_t> ids;
    for (const std::string& field : names) {
        const auto known = std::find(table_.names().begin(), table_.names().end(), csv_text(field));
        if (field != "time" && known == table_.names().end())
            return failure(fmt::format("the run has no column '{}', which the file has", shown(field)));
        ids.push_back(field == "time" ? time_column : static_cast<std::size_t>(known - table_.names().begin()));
    }
    for (std::size_t row = 0; row < std::min(rows_.size(), golden.size() - 1); ++row) {
        const RowTexts& expected = golden[row + 1];
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::string actual = ids[i] == time_column ? rows_[row].time : cell(rows_[row], ids[i]);
            const std::string wanted = i < expected.size() ? expected[i] : "";
            if (actual == wanted) continue;
            const std::string where = fmt::format("line {}, at {} s: {}", row + 2, rows_[row].time, shown(names[i]));
            const auto a = finite_in(actual);
            const auto b = finite_in(wanted);
            if (!a || !b)
                return failure(fmt::format("{} is {}, not {}", where, shown_cell(actual), shown_cell(wanted)));
            const double off = std::abs(*a - *b);
            if (off <= tolerance_) continue;
            return failure(fmt::format("{} is {}, off {} by {:.6g}, more than the tolerance of {}", where, actual,
                                       shown(wanted), off, tolerance_));
        }
    }
    if (rows_.size() + 1 != golden.size())
        return failure(fmt::format("the run has {} rows, the file {}", rows_.size(), golden.size() - 1));
    return {};
}

Expected<void> GoldenOwners::add(const std::vector<GoldenUse>& uses, const std::string& run) {
    for (const GoldenUse& use : uses) {
        if (use.written == 0) continue;
        const auto& [other, first] = owners_.try_emplace(use.file, Owner{run, use}).first->second;
        if (first.written == use.written) continue;
        return failure(
            fmt::format("golden '{}': {}, {}:{}, has already written other values to this file: choose another name",
                        std::filesystem::path(use.file).filename().string(), other, first.place.file, first.place.line),
            use.place);
    }
    return {};
}

// Never 0, because 0 means that nothing was written.
std::uint64_t Golden::fingerprint() const { return std::hash<std::string>{}(text()) | 1; }

Expected<void> Golden::finish(bool update) const {
    if (update) {
        const auto written = write_whole(file_, text());
        return written ? written : failure(fmt::format("golden '{}': {}", name_, written.error().message), place_);
    }
    const auto text = read_whole(file_, name_);
    if (!text) {
        return failure(
            fmt::format("golden '{}': {}; nezumi test --update-goldens writes it", name_, text.error().message),
            place_);
    }
    if (auto same = compare(*text); !same)
        return failure(fmt::format("golden '{}': {}", name_, same.error().message), place_);
    return {};
}

}  // namespace nezumi

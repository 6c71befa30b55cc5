// Cells are compared by the names of their columns, so that their order in the file does not matter.
#include "bindings/scenario/golden.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <type_traits>
#include <variant>

#include "bindings/lua/project/project.hpp"
#include "engine/ports/payload.hpp"

namespace nezumi {
namespace {

template <class T>
std::string text_of_cell(const T& value) {
    if constexpr (std::is_same_v<T, std::string>) {
        std::string text = "\"";
        for (const char c : value) {
            if (c == '"') text += '"';
            text += c == '\n' || c == '\r' ? ' ' : c;
        }
        return text + "\"";
    } else if constexpr (std::is_same_v<T, bool>) {
        return value ? "1" : "0";
    } else {
        return fmt::format("{}", value);
    }
}

std::vector<std::string> split(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) {
            cells.emplace_back();
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

std::vector<std::vector<std::string>> read_rows(std::string_view csv) {
    std::vector<std::vector<std::string>> rows;
    while (!csv.empty()) {
        const std::size_t end = std::min(csv.find('\n'), csv.size());
        if (end > 0) rows.push_back(split(csv.substr(0, end)));
        csv.remove_prefix(std::min(end + 1, csv.size()));
    }
    return rows;
}

std::optional<double> number_of(const std::string& text) {
    double number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
    return number;
}

std::string shown_cell(const std::string& text) { return text.empty() ? "nothing" : text; }

}  // namespace

std::size_t TraceTable::column(const std::string& name) {
    const auto [found, is_new] = places_.try_emplace(name, columns_.size());
    if (is_new) columns_.push_back(name);
    return found->second;
}

void TraceTable::add(double now) {
    Row row{{0, fmt::format("{:.9g}", now)}};
    for (const PortOf& port : ports_) {
        const auto found = port.live->system().port(port.path);
        if (!found || (*found)->count() == 0) continue;
        std::visit(
            [&](const auto& payload) {
                for_each_leaf(payload, [&](const std::string& path, const auto& value) {
                    if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(value)>, Octets>) {
                        const bool nested = !path.empty() && path.front() != '[';
                        row[column(port.path + (nested ? "." : "") + path)] = text_of_cell(value);
                    }
                });
            },
            (*found)->value());
    }
    rows_.push_back(std::move(row));
}

std::string TraceTable::cell(const Row& row, std::size_t column) const {
    const auto found = row.find(column);
    return found == row.end() ? "" : found->second;
}

std::string TraceTable::text() const {
    std::string out = fmt::format("{}\n", fmt::join(columns_, ","));
    for (const Row& row : rows_) {
        for (std::size_t i = 0; i < columns_.size(); ++i) out += (i > 0 ? "," : "") + cell(row, i);
        out += '\n';
    }
    return out;
}

Expected<void> TraceTable::compare(std::string_view csv, double tolerance) const {
    const auto golden = read_rows(csv);
    if (golden.empty()) return failure("the file is empty");
    const std::vector<std::string>& names = golden.front();
    for (const std::string& name : columns_) {
        if (std::find(names.begin(), names.end(), name) == names.end())
            return failure(fmt::format("the file has no column '{}'", name));
    }
    for (std::size_t row = 0; row < std::min(rows_.size(), golden.size() - 1); ++row) {
        const std::vector<std::string>& expected = golden[row + 1];
        for (std::size_t i = 0; i < names.size(); ++i) {
            const auto place = places_.find(names[i]);
            if (place == places_.end()) return failure(fmt::format("'{}' is only in the file", names[i]));
            const std::string actual = cell(rows_[row], place->second);
            const std::string wanted = i < expected.size() ? expected[i] : "";
            if (actual == wanted) continue;
            const std::string where = fmt::format("line {}, at {} s: {}", row + 2, cell(rows_[row], 0), names[i]);
            const auto a = number_of(actual);
            const auto b = number_of(wanted);
            if (!a || !b)
                return failure(fmt::format("{} is {}, not {}", where, shown_cell(actual), shown_cell(wanted)));
            const double off = std::abs(*a - *b);
            if (off <= tolerance) continue;
            return failure(fmt::format("{} is {}, off {} by {:.6g}, more than the tolerance of {}", where, actual,
                                       wanted, off, tolerance));
        }
    }
    if (rows_.size() + 1 != golden.size())
        return failure(fmt::format("the run has {} rows, the file {}", rows_.size(), golden.size() - 1));
    return {};
}

Expected<void> Golden::finish(bool update) const {
    if (update) {
        std::ofstream out(file, std::ios::binary);
        out << table.text();
        out.close();
        return out ? Expected<void>() : failure(fmt::format("golden '{}': can't be written", name), place);
    }
    const auto text = read_text_file(file, name);
    if (!text) {
        return failure(
            fmt::format("golden '{}': {}; nezumi test --update-goldens writes it", name, text.error().message), place);
    }
    if (auto same = table.compare(*text, tolerance); !same)
        return failure(fmt::format("golden '{}': {}", name, same.error().message), place);
    return {};
}

}  // namespace nezumi

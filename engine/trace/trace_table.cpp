// Values come in the same order each time, so the search for a column begins behind the previous column.
#include "engine/trace/trace_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "engine/base/csv.hpp"

namespace nezumi {
namespace {

std::string cell_of(const ValueView& leaf) {
    if (leaf.type->kind == Type::Kind::text) return csv_quoted(leaf.as<std::string>());
    return visit_number(leaf, []<class T>(const T& number) {
        if constexpr (std::is_same_v<T, bool>) return std::string(number ? "1" : "0");
        if constexpr (std::is_floating_point_v<T>) {
            if (std::isnan(number)) return std::string("nan");  // without its sign
        }
        return fmt::format("{}", number);
    });
}

}  // namespace

TraceTable::TraceTable(const std::vector<const Channel*>& channels) {
    for (const Channel* channel : channels) follow(*channel);
}

void TraceTable::follow(const Channel& channel) {
    Source& source = sources_.emplace_back(Source{&channel});
    // Adds the columns already before the first message.
    std::size_t at = 0;
    channel.visit_latest([&](const LeafPath& path, const ValueView&) { set_cell(source, at, path, ""); });
}

void TraceTable::set_cell(Source& source, std::size_t& at, const LeafPath& path, std::string text) {
    auto& columns = source.columns;
    std::string name = path.text();
    std::size_t found = at;
    while (found < columns.size() && columns[found].path != name) ++found;
    if (found == columns.size()) {
        if (fixed_) return;
        found = at;
        columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(at), {std::move(name), cells_.size()});
        cells_.emplace_back();
        names_.push_back(source.channel->name_of(path));
    }
    cells_[columns[found].id] = std::move(text);
    at = found + 1;
}

// Fills the cells of a source from this message, or from the latest.
void TraceTable::fill(Source& source, std::optional<std::size_t> message) {
    for (const Column& column : source.columns) cells_[column.id].clear();
    std::size_t at = 0;
    const LeafVisitor set = [&](const LeafPath& path, const ValueView& leaf) {
        set_cell(source, at, path, source.has_value ? cell_of(leaf) : "");
    };
    if (message) return source.channel->visit(*message, set);
    source.channel->visit_latest(set);
}

void TraceTable::read(const std::function<void(const std::vector<std::string>& cells)>& add) {
    std::size_t rows = 1;
    for (Source& source : sources_) {
        const Channel& channel = *source.channel;
        if (channel.turn() != source.turn) rows = std::max(rows, channel.fresh());
    }
    for (std::size_t row = 0; row < rows; ++row) {
        for (Source& source : sources_) {
            const Channel& channel = *source.channel;
            const std::size_t fresh = channel.turn() != source.turn ? channel.fresh() : 0;
            const bool had_value = std::exchange(source.has_value, channel.has_value());
            if (row < fresh) {
                fill(source, row);
            } else if (row == 0 && had_value != source.has_value) {
                fill(source, std::nullopt);
            }
        }
        add(cells_);
    }
    for (Source& source : sources_) source.turn = source.channel->turn();
}

void TraceTable::read_latest(const std::function<void(const std::vector<std::string>& cells)>& add) {
    for (Source& source : sources_) {
        const bool had_value = std::exchange(source.has_value, source.channel->has_value());
        if (std::exchange(source.turn, source.channel->turn()) != source.channel->turn() ||
            had_value != source.has_value)
            fill(source, std::nullopt);
    }
    add(cells_);
}

std::vector<std::size_t> TraceTable::order() const {
    std::vector<std::size_t> ids;
    for (const Source& source : sources_) {
        for (const Column& column : source.columns) ids.push_back(column.id);
    }
    return ids;
}

std::string TraceTable::header() const {
    std::vector<std::string> fields{"time"};
    for (const std::size_t id : order()) fields.push_back(csv_field(names_[id]));
    return csv_row(fields);
}

std::string TraceTable::row(std::string_view time, const std::vector<std::size_t>& ids,
                            const std::vector<std::string>& cells) {
    std::vector<std::string_view> fields{time};
    for (const std::size_t id : ids) fields.push_back(id < cells.size() ? std::string_view(cells[id]) : "");
    return csv_row(fields);
}

}  // namespace nezumi

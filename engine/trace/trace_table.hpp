// The values of channels as a table: rows of texts, with columns that are added when they are needed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/trace/channel.hpp"

namespace nezumi {

/// A column for each number, boolean (0 or 1) and text (in CSV quotes) of each channel, named as in the console. A
/// cell contains the latest value; it is empty before the first one, and if a list is shorter than its maximum length.
/// Pixels are omitted.
class TraceTable {
public:
    /// The channels must outlive this object.
    explicit TraceTable(const std::vector<const Channel*>& channels);
    /// Adds a channel after the others. A channel that is added after `fix_columns` gets no columns.
    void follow(const Channel& channel);

    /// Call this after a tick: calls `add` with the cells of its row, by their ids. If a channel has several messages
    /// in a tick, the tick has a row for each: a row has the next message of every channel, or its last one if there
    /// are fewer.
    void read(const std::function<void(const std::vector<std::string>& cells)>& add);
    /// Like `read`, for a table of selected ticks: one row with the latest value of each channel.
    void read_latest(const std::function<void(const std::vector<std::string>& cells)>& add);
    /// The ids of the columns in the order of the channels and their values. An id never changes.
    std::vector<std::size_t> order() const;
    /// "time,mouse.out.vx,mouse.out.vy": the names of the columns in this order, as CSV, after the time.
    std::string header() const;
    /// "0.01,0.2,0": a row for a header with these ids. The cell of a column that was added later is empty.
    static std::string row(std::string_view time, const std::vector<std::size_t>& ids,
                           const std::vector<std::string>& cells);
    /// The number of ids, which grows when columns are added.
    std::size_t width() const { return cells_.size(); }
    /// Stops adding columns.
    void fix_columns() { fixed_ = true; }
    /// The names of the columns, by id.
    const std::vector<std::string>& names() const { return names_; }

private:
    struct Column {
        std::string path;
        std::size_t id;
    };
    struct Source {
        const Channel* channel;
        std::vector<Column> columns{};
        std::uint64_t turn = 0;  // `turn` of the channel at the last reading
        bool has_value = false;
    };

    void fill(Source& source, std::optional<std::size_t> message);
    void set_cell(Source& source, std::size_t& at, const LeafPath& path, std::string text);

    std::vector<Source> sources_;
    std::vector<std::string> cells_;  // by id
    std::vector<std::string> names_;  // by id
    bool fixed_ = false;
};

}  // namespace nezumi

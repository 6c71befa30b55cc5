// What channels carried as a table: rows of texts, and columns that come as they are needed.
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

/// A column for each number, truth value (0 or 1) and text (in CSV's quotes) of each channel, called as a console
/// would. A cell holds what was carried last: it is empty before anything was, and where a list is shorter than it was
/// at its longest. Pixels are left out.
class TraceTable {
public:
    /// The channels must outlive it.
    explicit TraceTable(const std::vector<const Channel*>& channels);
    /// Another one, behind those that are there; it adds no columns when these are fixed.
    void follow(const Channel& channel);

    /// To be called after a tick: calls `add` with the cells of its row, by their ids. A tick in which a channel had
    /// several messages has as many rows: in each the channels' next message, or the last where one had fewer.
    void read(const std::function<void(const std::vector<std::string>& cells)>& add);
    /// The same for a table of some ticks alone: one row, of what each channel carried last.
    void read_latest(const std::function<void(const std::vector<std::string>& cells)>& add);
    /// The columns' ids in the order of the channels and their values. An id, once given, stays.
    std::vector<std::size_t> order() const;
    /// "time,mouse.out.vx,mouse.out.vy": the columns' names in this order, as CSV, behind that of the time.
    std::string header() const;
    /// "0.01,0.2,0": a row below a header of these ids. A cell is empty whose column came after the row.
    static std::string row(std::string_view time, const std::vector<std::size_t>& ids,
                           const std::vector<std::string>& cells);
    /// How many ids there are: more than before when columns have been added.
    std::size_t width() const { return cells_.size(); }
    /// From now on no columns are added.
    void fix_columns() { fixed_ = true; }
    /// The name of each id.
    const std::vector<std::string>& names() const { return names_; }

private:
    struct Column {
        std::string path;
        std::size_t id;
    };
    struct Source {
        const Channel* channel;
        std::vector<Column> columns{};
        std::uint64_t turn = 0;  // of the channel when it was read last
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

// A trace in a file that a run must follow within a tolerance.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bindings/scenario/run_result.hpp"
#include "engine/base/error.hpp"
#include "engine/trace/trace_table.hpp"

namespace nezumi {

/// The request of `s:golden`: a table as `TraceTable` makes it, with a column for the time [s].
class Golden {
public:
    /// `name` is the file name in the scenario. The channels must outlive this object.
    Golden(std::filesystem::path file, std::string name, double tolerance, Place place,
           const std::vector<const Channel*>& channels)
        : file_(std::move(file)),
          name_(std::move(name)),
          tolerance_(tolerance),
          place_(std::move(place)),
          table_(channels) {}

    /// Adds a row with the current values at time `now`.
    void add(double now);
    /// Compares with the file, or writes it. The error names the first cell that differs.
    Expected<void> finish(bool update) const;
    /// A hash of the text that `finish` writes.
    std::uint64_t fingerprint() const;

private:
    struct Row {
        std::string time;
        std::vector<std::string> cells;  // by the ids of the table
    };

    std::string cell(const Row& row, std::size_t id) const { return id < row.cells.size() ? row.cells[id] : ""; }
    std::string text() const;
    Expected<void> compare(const std::string& csv) const;

    std::filesystem::path file_;
    std::string name_;
    double tolerance_;
    Place place_;
    TraceTable table_;
    std::vector<Row> rows_;
};

/// Knows which run has written which golden. Several runs may compare with one file, but two runs that write it
/// differently would overwrite each other.
class GoldenOwners {
public:
    /// Adds the goldens that a run has written; an error if another run has written one differently.
    Expected<void> add(const std::vector<GoldenUse>& uses, const std::string& run);

private:
    struct Owner {
        std::string run;
        GoldenUse use;
    };
    std::map<std::string, Owner> owners_;  // by file
};

}  // namespace nezumi

// A committed trace that a run must follow within a tolerance.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/scenario/run_result.hpp"
#include "engine/base/error.hpp"
#include "engine/trace/trace_table.hpp"

namespace nezumi {

/// What `s:golden` asked for: a table as `TraceTable` makes it, with the time [s] before it.
class Golden {
public:
    /// `name` is the file's as the scenario gives it. The channels must outlive this.
    Golden(std::filesystem::path file, std::string name, double tolerance, Place place,
           const std::vector<const Channel*>& channels)
        : file_(std::move(file)),
          name_(std::move(name)),
          tolerance_(tolerance),
          place_(std::move(place)),
          table_(channels) {}

    /// Adds what the step brought that led to this time.
    void add(double now);
    /// Compares with the file, or writes it. The error names the first cell that differs.
    Expected<void> finish(bool update) const;
    /// A hash of what `finish` writes.
    std::uint64_t fingerprint() const;

private:
    struct Row {
        std::string time;
        std::vector<std::string> cells;  // by the table's ids
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

/// Which run has written which golden. Several may compare with one; two that write it differently would undo each
/// other's work.
class GoldenOwners {
public:
    /// Notes those that a run has written; an error at the place of one that another run has written differently.
    Expected<void> add(const std::vector<GoldenUse>& uses, const std::string& run);

private:
    struct Owner {
        std::string run;
        GoldenUse use;
    };
    std::map<std::string, Owner> owners_;  // by file
};

}  // namespace nezumi

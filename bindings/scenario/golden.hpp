// A committed trace that a run must follow within a tolerance.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/live/live_system.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

/// The values of some ports after every tick, as a table: the first column is the time [s], then one for each number,
/// truth value (0 or 1) and text of each port.
class TraceTable {
public:
    struct PortOf {
        LiveSystem* live;
        std::string path;  ///< "name.port"
    };
    explicit TraceTable(std::vector<PortOf> ports) : ports_(std::move(ports)) {}

    /// Adds a row for this time.
    void add(double now);
    /// As CSV.
    std::string text() const;
    /// Whether the CSV text says the same, its numbers within the tolerance. The error names the first cell that
    /// differs.
    Expected<void> compare(std::string_view csv, double tolerance) const;

private:
    using Row = std::map<std::size_t, std::string>;  // cells by column; what is not there is empty

    std::size_t column(const std::string& name);
    std::string cell(const Row& row, std::size_t column) const;

    std::vector<PortOf> ports_;
    std::vector<std::string> columns_{"time"};
    std::map<std::string, std::size_t, std::less<>> places_{{"time", 0}};
    std::vector<Row> rows_;
};

/// What `s:golden` asked for.
struct Golden {
    std::filesystem::path file;
    std::string name;  ///< as the scenario gives it
    double tolerance = 0;
    Place place{};
    TraceTable table;

    /// Compares with the file, or writes it.
    Expected<void> finish(bool update) const;
};

}  // namespace nezumi

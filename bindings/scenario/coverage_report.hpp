// The coverage of all runs of a session: as text, and as the tracefile that lcov and editors read.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings/lua/sandbox/coverage.hpp"

namespace nezumi {

class CoverageReport {
public:
    /// Adds a run of this scenario.
    void add(const std::string& scenario, const std::vector<FileCoverage>& files);
    /// Adds a file with this text as one that no scenario loads, unless a scenario has loaded it.
    void add_unloaded(const std::string& file, const std::string& text);
    bool empty() const { return files_.empty(); }

    /// "coverage: 120 of 125 lines (96.0 %), 40 of 44 branches (90.9 %) of 5 files, 1 of which no scenario loads".
    std::string summary() const;
    /// A tracefile of lcov (geninfo(1)): a section for each scenario and file. Counts are numbers of runs.
    std::string lcov() const;
    /// A table of the files, and each file with the number of scenarios that ran each line. `read` gives the text of
    /// a file with this hash; nothing if it is not known, then the lines are missing.
    std::string text(
        const std::function<std::optional<std::string>(const std::string& file, std::uint64_t hash)>& read) const;

private:
    using Way = std::tuple<int, int, int>;  // line, number of the branch in its line, way

    // For each line and each way, the number of runs or of scenarios that executed it.
    struct Counts {
        std::map<int, std::size_t> lines;
        std::map<Way, std::size_t> ways;

        static std::string text(std::size_t ran, std::size_t all, const char* what);
        std::string text() const;
    };
    struct File {
        std::uint64_t hash = 0;
        std::vector<std::pair<std::string, Counts>>
            scenarios;       // counts of runs for each scenario; one without a name: no scenario loads the file
        Counts all() const;  // number of scenarios
        bool is_loaded() const { return !scenarios.front().first.empty(); }
    };

    std::map<std::string, File> files_;
};

}  // namespace nezumi

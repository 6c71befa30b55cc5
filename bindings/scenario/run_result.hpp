// The result of one run of a scenario, as data that its process sends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/sandbox/coverage.hpp"
#include "bindings/scenario/sweep.hpp"
#include "engine/base/error.hpp"

namespace nezumi {

enum class RunOutcome : unsigned char {
    passed,
    failed,
    could_not_run,  ///< the run does not show how good the tested behaviour is: a file is missing, a script does not
                    ///< end, or it crashed
};

/// A number that a run records with `s:measure`.
struct Measure {
    std::string name;
    double value = 0;  ///< finite
    std::string unit;  ///< "" for none

    bool operator==(const Measure&) const = default;
};

/// How near a condition came to failing.
struct ConditionMargin {
    std::string kind;                ///< "always", "wait_until", ...
    std::string condition;           ///< its name
    std::optional<double> margin{};  ///< finite; negative where it failed
    std::string unit{};              ///< "" if unknown
    std::string comparison{};        ///< the comparison that decided; "" if the margin is the time left
    double time = 0;                 ///< [s] simulated, when it was so near
    std::optional<double> left{};    ///< [s] from the event, or the start of the hold, to the deadline
    std::string why{};               ///< the reason if there is no margin

    bool operator==(const ConditionMargin&) const = default;
};

/// A value that a run drew with `s:any`, or that a search chose, and what it was drawn from.
struct DrawnValue {
    std::string name;   ///< "gust.at", or the key of the sweep
    std::string text;   ///< as in the names of runs
    double number = 0;  ///< of a range
    SweepRange range{};
    std::vector<std::string> choices{};  ///< texts of a list; empty for a range

    bool operator==(const DrawnValue&) const = default;
};

/// A golden that a run compared with, or wrote.
struct GoldenUse {
    std::string file;           ///< its path
    Place place;                ///< of `s:golden`
    std::uint64_t written = 0;  ///< a hash of the text that it wrote; 0: it compared

    bool operator==(const GoldenUse&) const = default;
};

struct RunResult {
    RunOutcome outcome = RunOutcome::passed;
    Error error{};                   ///< the failure, with the line of the scenario
    bool component_failed = false;   ///< it failed because a component went to ERROR
    std::vector<std::string> facts;  ///< more about the failure, one fact per line: differences, times, values, a plot
    std::vector<ConditionMargin> margins{};  ///< margins of its conditions, in order; `always` and `never` first
    std::vector<std::string> printed;        ///< the output of the scenario, and warnings
    std::vector<Measure> measures{};         ///< in the order of `s:measure`, each name once
    std::vector<DrawnValue> drawn{};         ///< in the order of `s:any`; of a search, all values of the run
    std::vector<GoldenUse> goldens{};        ///< each file once
    std::vector<FileCoverage> coverage{};    ///< of the files that it loaded, if coverage is on
    std::string folder;                      ///< the folder of a failure's files; empty: there are none
    std::vector<std::string> files;          ///< their names
    std::vector<std::string> reads{};        ///< paths of the files that its worlds have read, sorted
    double seconds = 0;                      ///< simulated
    double wall_seconds = 0;                 ///< real time of the run
    std::uint64_t hash = 0;                  ///< of all published messages

    bool operator==(const RunResult&) const = default;
};

/// Convert a result to bytes and back. Bytes that `to_bytes` did not make give an error.
std::string to_bytes(const RunResult& result);
Expected<RunResult> from_bytes(std::string_view bytes);

}  // namespace nezumi

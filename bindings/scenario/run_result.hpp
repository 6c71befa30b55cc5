// What one run of a scenario gave: as data that travels from the process that ran it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

enum class RunOutcome : unsigned char {
    passed,
    failed,
    could_not_run,  ///< it says nothing about what was tried: a file is missing, a script runs without end, a crash
};

/// A number that a run keeps by `s:measure`.
struct Measure {
    std::string name;
    double value = 0;  ///< finite
    std::string unit;  ///< "" for none

    bool operator==(const Measure&) const = default;
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
    Error error{};                     ///< what failed, with the scenario's line
    bool component_failed = false;     ///< it failed because a component went to ERROR
    std::vector<std::string> facts;    ///< more about it, a line each: by how much, when, values, a plot
    std::vector<std::string> margins;  ///< how near the conditions came to their limits, a line each
    std::vector<std::string> printed;  ///< what the scenario printed, and what was warned of
    std::vector<Measure> measures{};   ///< in the order in which they were taken, each name once
    std::vector<GoldenUse> goldens{};  ///< each file once
    std::string folder;                ///< where the files of a failure lie; empty: there are none
    std::vector<std::string> files;    ///< their names
    double seconds = 0;                ///< simulated
    double wall_seconds = 0;           ///< that it took
    std::uint64_t hash = 0;            ///< of everything that was published

    bool operator==(const RunResult&) const = default;
};

/// As bytes, and back. What `to_bytes` did not make gives an error.
std::string to_bytes(const RunResult& result);
Expected<RunResult> from_bytes(std::string_view bytes);

}  // namespace nezumi

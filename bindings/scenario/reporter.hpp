// Reports a session of scenarios: to people, as TAP, and as JUnit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/scenario/margins.hpp"
#include "bindings/scenario/measured_pairs.hpp"
#include "bindings/scenario/measures.hpp"
#include "bindings/scenario/run_result.hpp"

namespace nezumi {

/// The report of one run.
struct RunReport {
    std::string file;        ///< of the scenario
    int line = 0;            ///< of the scenario
    std::string scenario;    ///< its name
    std::string name;        ///< with the values of its sweep
    std::uint64_t seed = 0;  ///< of the run
    std::string again;       ///< the command that repeats it
    RunResult result;
};

/// A file that could not be read is a report without a scenario.
struct SessionSummary {
    std::size_t passed = 0;
    std::size_t failed = 0;
    std::size_t could_not_run = 0;
    double seconds = 0;       ///< simulated, of all runs made in this session
    double wall_seconds = 0;  ///< of the session
    std::uint64_t seed = 0;
    std::size_t jobs = 0;
    std::size_t kept = 0;    ///< number of runs with results of earlier sessions; this session made the others
    std::size_t merged = 0;  ///< number of folders that were merged; 0: this session made the runs
    std::vector<MeasureSummary> measures;
    std::vector<PairSummary> pairs;
    std::vector<MarginSummary> margins;
};

using WriteText = std::function<void(std::string_view)>;

class Reporter {
public:
    virtual ~Reporter() = default;
    virtual void begin(std::size_t runs) = 0;
    /// Call this in the order of the plan.
    virtual void add(const RunReport& report) = 0;
    virtual void end(const SessionSummary& summary) = 0;
};

/// For people. `colour`: with terminal colours. `quiet`: omits runs that passed, except in the summary.
std::unique_ptr<Reporter> console_reporter(WriteText write, bool colour, bool quiet = false);
/// TAP version 13, with a diagnostic block for each failure.
std::unique_ptr<Reporter> tap_reporter(WriteText write);

/// A JUnit file of the whole session: a test suite for each file.
std::string junit_text(const std::vector<RunReport>& reports, const SessionSummary& summary);

/// The lines about a run that did not pass: location and reason, facts, files, and the command that repeats it.
std::vector<std::string> failure_lines(const RunReport& report);

}  // namespace nezumi

// How a session of scenarios is told: to a person, to TAP's and to JUnit's readers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/scenario/measured_pairs.hpp"
#include "bindings/scenario/measures.hpp"
#include "bindings/scenario/run_result.hpp"

namespace nezumi {

/// One run as it is told.
struct RunReport {
    std::string file;        ///< of the scenario
    int line = 0;            ///< of the scenario
    std::string scenario;    ///< its name
    std::string name;        ///< with the values of its sweep
    std::uint64_t seed = 0;  ///< of the run
    std::string again;       ///< the command that repeats it
    RunResult result;
};

/// A file that could not be read is one report without a scenario.
struct SessionSummary {
    std::size_t passed = 0;
    std::size_t failed = 0;
    std::size_t could_not_run = 0;
    double seconds = 0;       ///< simulated, of all runs but those kept
    double wall_seconds = 0;  ///< of the session
    std::uint64_t seed = 0;
    std::size_t jobs = 0;
    std::size_t kept = 0;    ///< runs whose results are of earlier sessions: this one made the others
    std::size_t merged = 0;  ///< folders whose results these are; 0: the session made them
    std::vector<MeasureSummary> measures;
    std::vector<PairSummary> pairs;
};

using WriteText = std::function<void(std::string_view)>;

class Reporter {
public:
    virtual ~Reporter() = default;
    virtual void begin(std::size_t runs) = 0;
    /// In order.
    virtual void add(const RunReport& report) = 0;
    virtual void end(const SessionSummary& summary) = 0;
};

/// For people. `colour`: with the terminal's colours. `quiet`: nothing of runs that passed, but for the summary.
std::unique_ptr<Reporter> console_reporter(WriteText write, bool colour, bool quiet = false);
/// TAP version 13, a diagnostic block for each failure.
std::unique_ptr<Reporter> tap_reporter(WriteText write);

/// A JUnit file of the whole session: a test suite for each file.
std::string junit_text(const std::vector<RunReport>& reports, const SessionSummary& summary);

/// All that is to be said of a run that did not pass, a line each: where and what, the facts, the files, the command.
std::vector<std::string> failure_lines(const RunReport& report);

}  // namespace nezumi

// Finds the first tick in which two journaled runs differ, and the differing values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bindings/journal/replay.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

/// A value that a port published in the first tick that differs.
struct DifferingValue {
    std::string name;          ///< "controller.out.vx"
    std::string first;         ///< in the first run; "nothing" if the port published nothing in this tick
    std::string second;        ///< in the second run
    std::optional<double> by;  ///< the difference of numbers
};

/// A line that only one of the runs executed, or executed with these values.
struct DifferingLine {
    bool of_first = true;
    std::string text;  ///< "keeper.lua:9  local near = 3   near = 31"
};

/// The parts of a port's value in which two messages differ, numbers by more than `tolerance`. Null: no message.
std::vector<DifferingValue> differing_values(const std::string& port, const Value* first, const Value* second,
                                             double tolerance);

struct RunDifference {
    ActTime when{};         ///< the first tick that differs, in the first run
    ActTime second_when{};  ///< the same tick in the second run; its number differs after restarts at other ticks
    double seconds = 0;     ///< [s] time of the tick
    std::vector<DifferingValue> values{};               ///< the differing values, in the order of the system
    std::size_t more_values = 0;                        ///< number of differing values that are left out
    std::string component{};                            ///< the first behaviour whose ports differ; "" for none
    std::optional<std::vector<DifferingLine>> lines{};  ///< of its execution; nothing if it can't be repeated
};

struct RunComparison {
    std::optional<RunDifference> difference;  ///< nothing: all published messages are equal until one of the runs ends
    double first_end = 0, second_end = 0;     ///< [s] ends of the two runs; valid if there is no difference
    std::vector<std::string> files;           ///< the files whose texts differ when the runs start
};

/// Performs the next tick, and returns the lines that this component executed in it, with their values:
/// "keeper.lua:9  local near = 3   near = 31".
Expected<std::vector<std::string>> lines_of_next_tick(RunningSystem& live, const std::string& component);
/// Goes back to an earlier tick, repeats it, and returns the lines that this component executes in it.
Expected<std::vector<std::string>> traced_lines(RunningSystem& live, const ActTime& before,
                                                const std::string& component);

/// The lines that differ, without the common lines at the start and at the end.
std::vector<DifferingLine> differing_lines(const std::vector<std::string>& first,
                                           const std::vector<std::string>& second);

/// Performs two runs together, tick by tick. An error if one of them can't be replayed.
Expected<RunComparison> compare_runs(Replay& first, RunningSystem& of_first, Replay& second, RunningSystem& of_second);

}  // namespace nezumi

// The parts of a component that can be read besides ports and parameters: commands, tasks, probes, executed lines.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

/// A command, called as `component:name(...)`.
struct CommandDeclaration {
    std::string name;
    std::string doc;
    Place place;
};

/// The present status of a task.
struct TaskStatus {
    std::string name;
    std::string status;     ///< "ready", "running", "waiting", ...
    double since = 0;       ///< [s] time of the last change of status
    std::string waiting{};  ///< "1.5 s, 0.7 s are left", "a condition"; "" when it does not wait
    int line = 0;           ///< the line where it waits
};

/// A value that a script shows with `probe`.
struct Probe {
    std::string name;
    PlainData value;  ///< one number, boolean or text, or a flat table of these
    double tm = 0;    ///< [s] time when it was set
};

/// The lines that one execution has run.
struct TracedLines {
    /// The value of a variable.
    struct Value {
        std::string name;
        std::string text;
        bool operator==(const Value&) const = default;
    };
    struct Line {
        std::string file;  ///< the file's name in messages
        int line = 0;
        int depth = 0;                ///< number of calls from the outermost function
        std::vector<Value> values{};  ///< of the variables in the line; of all visible variables if the text is unknown
        std::string text{};           ///< the text of the line, without blanks around it; "" if it is unknown
        /// If the last round of a long loop begins with this line: the number of equal rounds before it that are
        /// omitted.
        std::size_t turns_left_out = 0;
    };
    std::vector<Line> lines{};
    bool is_cut = false;  ///< there were more lines
};

/// The run times of a component, one for each tick.
struct TickCosts {
    static constexpr std::size_t most_times = 1'000'000;
    std::vector<std::int64_t> times{};  ///< [ns] at most `most_times`
    std::int64_t tick = -1;             ///< the tick of the last time

    void add(std::int64_t of_tick, std::int64_t nanoseconds) {
        if (of_tick == tick) {
            times.back() += nanoseconds;
        } else if (times.size() < most_times) {
            times.push_back(nanoseconds);
            tick = of_tick;
        }
    }
};

/// The functions of a script that were running when an error occurred, the innermost first.
struct ErrorFrames {
    struct Variable {
        std::string name;
        std::string text;  ///< as people see it
        Value value;       ///< a number, a boolean, or a text; for a table the text that people see
    };
    struct Frame {
        std::string file;                ///< the file's name in messages
        int line = 0;                    ///< the line that the function was executing
        std::string name{};              ///< the name by which the function was called; "" if unknown
        std::vector<Variable> locals{};  ///< the function's variables that have a value
    };
    std::vector<Frame> all{};
};

/// Adds a list of tables with `file`, `line`, `name` and `locals`; returns the value that refers to it.
Value add_frames(const ErrorFrames& frames, PlainData& data);

/// A table from each name to `status`, `since`, and for waiting tasks `waiting` and `line`.
PlainData describe(std::span<const TaskStatus> tasks);
/// A table from each name to its `value`, `tm` and `age` at this time [s].
PlainData describe(std::span<const Probe> probes, double now);
/// For recordings: a table from each name to its value.
PlainData values_of(std::span<const Probe> probes);

}  // namespace nezumi

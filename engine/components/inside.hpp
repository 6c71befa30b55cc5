// What a component shows of its inside, beside ports and parameters: commands, tasks, probes, the lines that ran.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/values/plain_data.hpp"

namespace nezumi {

/// A command that it offers, callable as `component:name(...)`.
struct CommandDeclaration {
    std::string name;
    std::string doc;
    Place place;
};

/// A task, as it is now.
struct TaskStatus {
    std::string name;
    std::string status;     ///< "ready", "running", "waiting", ...
    double since = 0;       ///< [s] when it got this status
    std::string waiting{};  ///< "1.5 s, 0.7 s are left", "a condition"; "" when it does not wait
    int line = 0;           ///< where it waits
};

/// A value that it shows.
struct Probe {
    std::string name;
    PlainData value;  ///< one number, truth value or text, or one flat table of them
    double tm = 0;    ///< [s] when it was set
};

/// The lines that ran in one execution.
struct TracedLines {
    /// Of a variable.
    struct Value {
        std::string name;
        std::string text;
        bool operator==(const Value&) const = default;
    };
    struct Line {
        std::string file;  ///< as messages call it
        int line = 0;
        int depth = 0;                ///< calls within the outermost function
        std::vector<Value> values{};  ///< of the variables that it names, or of all in sight where there is no text
        std::string text{};           ///< of the file, without blanks around it; "" where it is not known any more
        /// Where the last turn of a long loop begins: so many turns before it, of the same lines, are left out.
        std::size_t turns_left_out = 0;
    };
    std::vector<Line> lines{};
    bool is_cut = false;  ///< there were more
};

/// A table from each name to `status`, `since`, and of those that wait `waiting` and `line`.
PlainData describe(std::span<const TaskStatus> tasks);
/// A table from each name to its `value`, `tm` and `age` at this time [s].
PlainData describe(std::span<const Probe> probes, double now);
/// For recordings: a table from each name to its value.
PlainData values_of(std::span<const Probe> probes);

}  // namespace nezumi

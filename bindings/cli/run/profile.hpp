// What `nezumi run --profile FILE` measures and writes.
#pragma once

#include <map>
#include <string>

#include "bindings/lua/sandbox/line_profile.hpp"
#include "engine/base/error.hpp"
#include "engine/live/run_loop.hpp"

namespace nezumi::cli {

class RunProfile {
public:
    /// `file` ends in .svg (a flame graph) or .json (for speedscope and Perfetto).
    explicit RunProfile(std::string file) : file_(std::move(file)) {}

    /// Measures every execution of behaviours from now on, with their lines, and the ticks of native components. This
    /// object and the loop must outlive all ticks.
    void follow(RunLoop& loop);
    /// Ends the measurement and writes the file. Returns the table of costs.
    Expected<std::string> finish(const RunningSystem& live);

private:
    void measure(const RunningSystem& live);

    std::string file_;
    std::map<std::string, ExecutionProfile> components_;
    std::map<std::string, TickCosts> natives_;
    int generation_ = -1;
    std::size_t count_ = 0;  // of components
};

}  // namespace nezumi::cli

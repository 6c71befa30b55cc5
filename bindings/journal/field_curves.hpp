// The numbers of fields of out-ports over time, to draw how two runs differ.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bindings/journal/replay.hpp"
#include "engine/base/error.hpp"
#include "engine/live/running_system.hpp"

namespace nezumi {

class FieldCurves {
public:
    /// Time [s], ascending, and value.
    using Points = std::vector<std::pair<double, double>>;

    /// Keeps only these fields ("keeper.out.vx"); all fields if the set is empty.
    explicit FieldCurves(std::set<std::string> fields = {}) : fields_(std::move(fields)) {}

    /// Adds the numbers of a message that the port "keeper.out" published at this time [s].
    void add(const std::string& port, const Value& message, double seconds);
    /// The points of a field; none if it has no numbers.
    const Points& of(const std::string& field) const;
    /// The fields that have points.
    std::vector<std::string> names() const;

private:
    const std::set<std::string> fields_;
    std::map<std::string, Points> curves_;
};

/// Repeats a run from its beginning, and adds the numbers that out-ports publish after start number `start`. An error
/// if the run can't be repeated.
Expected<void> add_curves(FieldCurves& curves, Replay& replay, RunningSystem& live, int start);

}  // namespace nezumi

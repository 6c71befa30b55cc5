// The remembered acts, errors and values of a branch as JSON, for the page's time line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/live/running_system.hpp"

namespace nezumi::web {

/// The marks of a branch (acts, reloads, errors, collisions) and, with `rows`, where its robots and
/// moving things were, since the last start. An error if there is no such branch.
Expected<nlohmann::ordered_json> remembered_to_json(RunningSystem& live, const std::string& branch, bool rows);

/// The values of these ports and members at a time [s] of the present branch: for each one the stamp, and the numbers
/// and texts by their names. Values that are not remembered are left out; they are remembered from now on.
nlohmann::ordered_json then_to_json(Trace& trace, double at, const std::vector<std::string>& names);

/// Adds the numbers of a port that the trace remembers, for a plot: `labels`, and `values` as rows [time, number, ...].
/// Does not make the trace remember more ports.
void add_numbers(nlohmann::ordered_json& json, const Trace& trace, const std::string& port);

}  // namespace nezumi::web

// What is remembered of a branch as JSON for the page's time line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/live/running_system.hpp"

namespace nezumi::web {

/// The marks of a branch (acts, reloads, errors, collisions) and, with `rows`, where its robots and
/// moving things were, since the last start. An error if there is no such branch.
Expected<nlohmann::ordered_json> remembered_to_json(RunningSystem& live, const std::string& branch, bool rows);

/// What these ports and members had at a time [s] of the present branch: for each that is remembered its stamp, and its
/// numbers and texts by their names. The others are left out; members are remembered from now on.
nlohmann::ordered_json then_to_json(Trace& trace, double at, const std::vector<std::string>& names);

/// Adds the numbers of a port that the trace remembers, for a plot: `labels`, and `values` as rows [time, number, ...].
/// Nothing that was not remembered before is remembered from now on.
void add_numbers(nlohmann::ordered_json& json, const Trace& trace, const std::string& port);

}  // namespace nezumi::web

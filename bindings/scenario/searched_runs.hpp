// Performs the runs that searches choose.
#pragma once

#include <cstddef>
#include <vector>

#include "bindings/scenario/result_store.hpp"
#include "bindings/scenario/session_runs.hpp"

namespace nezumi {

/// Searches in each scenario that has runs of a search, one scenario after the other. Runs that a search did not need
/// are no longer runs of this part. Returns false if a signal interrupted.
bool search_all(SessionRuns& runs);

/// Takes the name and the values of a run of a search from the results of other sessions. Returns whether the search
/// ended before it.
bool merge_searched(SessionRuns& runs, std::size_t run, const std::vector<ResultStore>& merged);

}  // namespace nezumi

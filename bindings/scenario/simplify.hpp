// Simplifies failed runs whose values were random or found by a search.
#pragma once

#include <cstddef>
#include <optional>

#include "bindings/scenario/session_runs.hpp"

namespace nezumi {

/// The simplest run that fails in the same place as this one, with its result; the run itself if there is none. It is
/// kept for `--merge`. Nothing if a signal interrupted.
std::optional<KeptResult> simplify_failure(const SessionRuns& runs, std::size_t run);

/// The report about the simplest failure that was found from a run.
RunReport report_of_simplest(const SessionRuns& runs, std::size_t run, KeptResult simplest);

}  // namespace nezumi

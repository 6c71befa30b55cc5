// Simplifies the failures of drawn and searched runs.
#pragma once

#include <cstddef>
#include <optional>

#include "bindings/scenario/session_runs.hpp"

namespace nezumi {

/// The simplest run that fails in the same place as this one, with its result; the run itself if there is none. Kept
/// for those who merge. Nothing if a signal interrupted.
std::optional<KeptResult> simplify_failure(const SessionRuns& runs, std::size_t run);

/// The report about the simplest failure that was found from a run.
RunReport report_of_simplest(const SessionRuns& runs, std::size_t run, KeptResult simplest);

}  // namespace nezumi

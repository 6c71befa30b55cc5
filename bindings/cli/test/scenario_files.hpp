// The files of a failed scenario: the trace of each world, and a picture of it.
#pragma once

#include <filesystem>
#include <memory>

#include "bindings/scenario/scenario_run.hpp"

namespace nezumi::cli {

/// Writes `trace.csv` and `picture.png` to the folder, which must exist; for further worlds `trace_2.csv` and so on.
std::unique_ptr<RunFiles> scenario_files(const std::filesystem::path& folder);

}  // namespace nezumi::cli

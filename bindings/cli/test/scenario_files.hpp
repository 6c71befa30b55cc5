// What a failing scenario leaves in its folder: the trace of every world, and a picture of each.
#pragma once

#include <filesystem>
#include <memory>

#include "bindings/scenario/scenario_run.hpp"

namespace nezumi::cli {

/// Keeps `trace.csv` and `picture.png` in the folder, which must be there; of further worlds `trace_2.csv` and so on.
std::unique_ptr<RunFiles> scenario_files(const std::filesystem::path& folder);

}  // namespace nezumi::cli

// The files of `nezumi test --coverage`.
#pragma once

#include <string>

#include "bindings/scenario/coverage_report.hpp"
#include "engine/base/error.hpp"

namespace nezumi::cli {

/// Adds the behaviours and modules of the project of the working folder that no scenario has loaded.
void add_unloaded_files(CoverageReport& report);

/// Writes `coverage.txt` and `lcov.info` into an existing folder. Texts are read from the project of the working
/// folder.
Expected<void> write_coverage(const CoverageReport& report, const std::string& folder);

}  // namespace nezumi::cli

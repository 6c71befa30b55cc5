// Standard input, output and error: makes sure that they exist, and reports lost output.
#pragma once

#include <string>

namespace nezumi::cli {

/// Opens /dev/null in place of each of the three that was closed when the program started. Otherwise a file opened
/// later would get the free number, and messages would be written into it.
void open_missing_standard_files();

/// Flushes standard output. If output was lost since the last call, returns the reason; otherwise an empty text.
std::string lost_output();

}  // namespace nezumi::cli

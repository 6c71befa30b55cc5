// Standard input, output and error: makes sure that they exist, and reports lost output.
#pragma once

#include <string>

namespace nezumi::cli {

/// Opens /dev/null for those of the three that were closed at the start. Otherwise a file opened later would get their
/// number and the output for people.
void open_missing_standard_files();

/// Writes the rest of standard output. Returns the reason if output was lost, once; otherwise an empty text.
std::string lost_output();

}  // namespace nezumi::cli

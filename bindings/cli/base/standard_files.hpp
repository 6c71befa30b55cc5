// Standard input, output and error: that they are there, and that what was said has got through.
#pragma once

#include <string>

namespace nezumi::cli {

/// Opens /dev/null for those of the three that whoever started us has closed; a file that is opened later would take
/// their place, and get what is meant for a person.
void open_missing_standard_files();

/// Writes out what standard output still holds. Returns why something that was said there got lost, once; empty:
/// nothing.
std::string lost_output();

}  // namespace nezumi::cli

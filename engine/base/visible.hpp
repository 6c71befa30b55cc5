// Text from scripts, files and folders' names, made fit for terminals and logs.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

/// As a terminal may show it: control characters other than the end of line and the tab are written out ("\x1b"), and
/// so are the characters of Unicode that break lines or turn the direction of writing ("\u202e").
std::string visible(std::string_view text);

/// The same for a message in a log: its second line and those that follow begin with blanks and a bar, so that none of
/// them can be taken for a line of the log.
std::string visible_message(std::string_view text);

}  // namespace nezumi

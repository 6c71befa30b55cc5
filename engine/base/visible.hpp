// Makes text from scripts, files and names of folders safe for terminals and logs.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

/// Text for a terminal: control characters except the line end and the tab are written as "\x1b", and characters of
/// Unicode that break lines or change the direction of writing as "\u202e".
std::string visible(std::string_view text);

/// Text for a message in a log: like `visible`, but further lines begin with blanks and a bar, so that they can't be
/// taken for a line of the log.
std::string visible_message(std::string_view text);

}  // namespace nezumi

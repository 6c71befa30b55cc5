// The layout of text on a terminal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// Returns the row, counted from 0, of the cursor after writing `text` from the first column of row 0 on a terminal
/// with `columns`. The layout is libedit's: long lines wrap, and a control character has two columns.
int row_after(std::wstring_view text, int columns);

/// The common beginning of all candidates; there must be at least one.
std::string common_beginning(const std::vector<std::string>& candidates);

/// Returns the candidates as rows with line ends, to be read downwards. Only 200 are listed; the rest are counted.
std::string in_columns(const std::vector<std::string>& candidates, int columns);

}  // namespace nezumi

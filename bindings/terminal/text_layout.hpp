// How text is laid out on a terminal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nezumi {

/// The row, from 0, of the cursor after `text` was written from the first column of row 0 on a terminal of `columns`,
/// as libedit lays text out: what does not fit goes on in the next row, a control character is written as two.
int row_after(std::wstring_view text, int columns);

/// What all candidates begin with; there must be at least one.
std::string common_beginning(const std::vector<std::string>& candidates);

/// The candidates as rows, read downwards, each with its end of line. Those past the 200th are only counted.
std::string in_columns(const std::vector<std::string>& candidates, int columns);

}  // namespace nezumi

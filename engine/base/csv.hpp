// Tables of numbers in CSV files: a header row that names the columns, then rows of numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// A column that a table must have, and which numbers may stand in it.
struct CsvColumn {
    enum class Range {
        any,           ///< every finite number
        not_negative,  ///< 0 or more
        positive,      ///< more than 0
    };
    std::string_view name;
    Range range = Range::any;
};

struct CsvRow {
    std::vector<double> values;  ///< in the order of the columns that were asked for
    int line = 0;                ///< from 1
};

/// Reads a table with exactly these columns, in whatever order its header row has them. Fields are separated by commas
/// and may stand in quotes; blanks around them, a byte-order mark, CR LF, empty lines, rows of nothing but commas and
/// lines that begin with # are skipped. `file` is named in errors, which say the line, the column and what was found.
Expected<std::vector<CsvRow>> read_csv(std::string_view text, const std::string& file,
                                       const std::vector<CsvColumn>& columns);

}  // namespace nezumi

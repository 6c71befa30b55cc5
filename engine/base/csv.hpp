// CSV: how its rows and fields are written and taken apart, and tables of numbers.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// A text as a field: in quotes, those within it doubled.
std::string csv_quoted(std::string_view text);
/// The fields of a row as they stand there, with their quotes and blanks: commas within quotes separate nothing.
/// Nothing when a quote is not closed.
std::optional<std::vector<std::string_view>> split_csv_row(std::string_view row);
/// What such a field says: without its quotes and the blanks around it.
std::string csv_text(std::string_view field);
/// Reads the next row, which goes on over ends of line within quotes, without its last end of line. False at the end.
bool read_csv_row(std::istream& in, std::string& row);

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

/// The number in a field's text, or what was expected in this column.
Expected<double> csv_number(const std::string& text, const CsvColumn& column, const Place& place);

}  // namespace nezumi

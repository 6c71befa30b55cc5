// CSV: how its rows and fields are written and taken apart, and tables of numbers.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// A text as a field: in quotes, those within it doubled.
std::string csv_quoted(std::string_view text);
/// The same, in quotes only where it would not be read back without them.
std::string csv_field(std::string_view text);
/// Fields as they stand there, as a row without its end of line.
template <class Text>
std::string csv_row(const std::vector<Text>& fields) {
    std::string row;
    for (std::size_t i = 0; i < fields.size(); ++i) row.append(i > 0 ? 1 : 0, ',').append(fields[i]);
    return row;
}
/// The fields of a row as they stand there, with their quotes and blanks: commas within quotes separate nothing.
/// Nothing when a quote is not closed.
std::optional<std::vector<std::string_view>> split_csv_row(std::string_view row);
/// The same of any row: without the field whose quote is not closed, which takes in all that comes behind it.
std::vector<std::string_view> closed_csv_fields(std::string_view row);
/// What such a field says: without its quotes and the blanks around it.
std::string csv_text(std::string_view field);
/// Reads the next row, which goes on over ends of line within quotes, without its last end of line. False at the end.
bool read_csv_row(std::istream& in, std::string& row);
/// Where the row that begins at `from` ends, behind its end of line; nothing when it does not end in the text.
std::optional<std::size_t> end_of_csv_row(std::string_view text, std::size_t from);

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

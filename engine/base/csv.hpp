// Writes and splits rows and fields of CSV, and reads tables of numbers.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"

namespace nezumi {

/// A text as a field in quotes; inner quotes are doubled.
std::string csv_quoted(std::string_view text);
/// A text as a field, with quotes only if they are necessary.
std::string csv_field(std::string_view text);
/// Joins fields to a row without a line end.
template <class Text>
std::string csv_row(const std::vector<Text>& fields) {
    std::string row;
    for (std::size_t i = 0; i < fields.size(); ++i) row.append(i > 0 ? 1 : 0, ',').append(fields[i]);
    return row;
}
/// The fields of a row with their quotes and blanks; commas within quotes do not separate fields. Nothing if a quote is
/// not closed.
std::optional<std::vector<std::string_view>> split_csv_row(std::string_view row);
/// Like `split_csv_row`, but accepts a quote that is not closed: omits the field with this quote, which is the rest of
/// the row.
std::vector<std::string_view> closed_csv_fields(std::string_view row);
/// The text of a field of `split_csv_row`, without quotes and without blanks around it.
std::string csv_text(std::string_view field);
/// Reads the next row without its line end; line ends within quotes belong to the row. Returns false at the end of the
/// input.
bool read_csv_row(std::istream& in, std::string& row);
/// The position after the line end of the row that begins at `from`; nothing if the text has no such line end.
std::optional<std::size_t> end_of_csv_row(std::string_view text, std::size_t from);

/// A required column of a table, and its allowed numbers.
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
    std::vector<double> values;  ///< in the order of the requested columns
    int line = 0;                ///< from 1
};

/// Reads a table with exactly these columns, in the order of its header row. Fields are separated by commas and may be
/// in quotes. Skips blanks around fields, a byte order mark, CR LF, empty lines, rows of commas only, and lines that
/// begin with #. Errors have `file`, the line, the column and what was found.
Expected<std::vector<CsvRow>> read_csv(std::string_view text, const std::string& file,
                                       const std::vector<CsvColumn>& columns);

/// The number in the text of a field, or an error with what this column expects.
Expected<double> csv_number(const std::string& text, const CsvColumn& column, const Place& place);

}  // namespace nezumi

// Maps as existing simulators write them, and what was done with their rows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/world/arena_spec.hpp"

namespace nezumi {

struct CsvMap {
    std::vector<BoxSpec> boxes;      ///< one for each row that was taken
    int skipped = 0;                 ///< lines that are no box: comments, blank ones, rows of fewer than 7 columns
    bool header_is_numbers = false;  ///< the first line, which is skipped, reads like a row
};

/// Reads a map. The first line is a header, in any language and encoding: where it names all of the columns
/// `x,y,z,lx,ly,lz,yaw` (centre [m], size [m], yaw [rad]), they are taken by their names, else as the first seven in
/// this order. The rows are fixed boxes, whatever follows in them; comments, which begin with #, blank lines and rows
/// of fewer columns are skipped. It is an error when no row at all is a box; it says how the columns are separated. Of
/// a row with a quote that is not closed count the columns before it; it is an error when the row would be a box
/// without quotes. `file` is named in errors, which say line, column and what was found.
Expected<CsvMap> read_map(std::string_view text, const std::string& file);

/// "map.csv: 12 boxes, 2 lines that are no box skipped".
std::string describe(const CsvMap& map, const std::string& file);

}  // namespace nezumi

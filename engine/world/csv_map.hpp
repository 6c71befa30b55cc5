// Reads CSV maps of existing simulators.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/world/arena_spec.hpp"

namespace nezumi {

struct CsvMap {
    std::vector<BoxSpec> boxes;  ///< one for each used row
    int skipped = 0;             ///< number of lines without a box: comments, empty lines, rows of fewer than 7 columns
    bool header_is_numbers = false;  ///< the first line, which is skipped, has only numbers
};

/// Reads a map. The first line is a header, in any language and encoding. If it contains all of the columns
/// `x,y,z,lx,ly,lz,yaw` (centre [m], size [m], yaw [rad]), they are found by their names; otherwise the first seven
/// columns are used in this order. Each row is a fixed box; further columns are ignored. Skips comments (#), empty
/// lines and rows with fewer columns. An error if no row is a box; the error names a wrong separator. If a quote in a
/// row is not closed, only the columns before it count; an error if the row would be a box without quotes. Errors have
/// `file`, line, column and what was found.
Expected<CsvMap> read_map(std::string_view text, const std::string& file);

/// "map.csv: 12 boxes, 2 lines that are not boxes skipped".
std::string describe(const CsvMap& map, const std::string& file);

}  // namespace nezumi

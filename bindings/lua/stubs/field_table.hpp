// Described structures as the tables of the documentation's pages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/record_shape.hpp"

namespace nezumi {

/// A Markdown table with a line for each field.
std::string field_table(const RecordShape& record);

/// A page with the tables that it asks for: what stands between `<!-- fields: box -->` and `<!-- end -->` is the table
/// of that structure. An error names a structure that is not among `records`, or a marker without its end.
Expected<std::string> with_field_tables(std::string_view page, const std::vector<RecordShape>& records);

}  // namespace nezumi

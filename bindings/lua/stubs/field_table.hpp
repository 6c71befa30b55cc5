// Described structures as the tables of the documentation's pages.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/files/record_shape.hpp"

namespace nezumi {

/// A Markdown table with a line for each field.
std::string field_table(const RecordShape& record);

/// A page in which what stands between `<!-- KIND: NAME -->` and `<!-- end -->` is what `table` gives for that name, or
/// its error. A marker without its end is an error as well.
Expected<std::string> with_tables(std::string_view page, std::string_view kind,
                                  const std::function<Expected<std::string>(std::string_view name)>& table);

/// A page with the tables that it asks for: what stands between `<!-- fields: box -->` and `<!-- end -->` is the table
/// of that structure. An error names a structure that is not among `records`, or a marker without its end.
Expected<std::string> with_field_tables(std::string_view page, const std::vector<RecordShape>& records);

}  // namespace nezumi

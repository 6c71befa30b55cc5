// Tables of described structures and of members, as the documentation has them.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/records/record_shape.hpp"

namespace nezumi {

/// A page in which the text between `<!-- KIND: NAME -->` and `<!-- end -->` is replaced by `table(NAME)`, or an error
/// of it. A marker without its end is an error.
Expected<std::string> with_tables(std::string_view page, std::string_view kind,
                                  const std::function<Expected<std::string>(std::string_view name)>& table);

/// A page with the tables that it asks for: the text between `<!-- fields: box -->` and `<!-- end -->` becomes the
/// table of this structure. An error names a structure that is not in `records`, or a marker without its end.
Expected<std::string> with_field_tables(std::string_view page, const std::vector<RecordShape>& records);

/// A page with the tables that it asks for: `<!-- members: component -->`, `<!-- members: port -->`.
Expected<std::string> with_member_tables(std::string_view page);

}  // namespace nezumi

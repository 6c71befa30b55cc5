// Which names components, ports and parameters may have.
#pragma once

#include <string_view>

namespace nezumi {

/// Words that no component may be called: Lua's keywords and the console's words.
bool is_reserved_name(std::string_view name);
/// Letters, digits and underscores, not beginning with a digit, and no Lua keyword.
bool is_identifier(std::string_view name);

}  // namespace nezumi

// Whether bytes are text that other programs can read.
#pragma once

#include <string_view>

namespace nezumi {

/// True if all of it is valid UTF-8: no overlong forms, no surrogates.
bool is_utf8(std::string_view text);

}  // namespace nezumi

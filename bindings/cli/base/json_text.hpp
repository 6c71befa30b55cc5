// Texts as JSON strings.
#pragma once

#include <string>
#include <string_view>

namespace nezumi::cli {

/// Returns a text as a JSON string with its quotes; invalid UTF-8 becomes U+FFFD.
std::string json_text(std::string_view text);

}  // namespace nezumi::cli

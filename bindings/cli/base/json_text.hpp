// Texts as JSON writes them.
#pragma once

#include <string>
#include <string_view>

namespace nezumi::cli {

/// A text as a JSON string with its quotes; what is no UTF-8 becomes U+FFFD.
std::string json_text(std::string_view text);

}  // namespace nezumi::cli

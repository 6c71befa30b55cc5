// Text as XML.
#pragma once

#include <string>
#include <string_view>

namespace nezumi {

/// Text for content and attributes; bytes and characters that XML does not allow become question marks.
std::string xml_text(std::string_view text);

}  // namespace nezumi

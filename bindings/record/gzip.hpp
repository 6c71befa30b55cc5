// Gzip (RFC 1952), which browsers unpack.
#pragma once

#include <string>
#include <string_view>

namespace nezumi::record {

/// Compresses a text. The same text always gives the same bytes. Returns "" if there is not enough memory.
std::string gzipped(std::string_view text);

}  // namespace nezumi::record

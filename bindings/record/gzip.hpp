// Gzip (RFC 1952), which browsers unpack.
#pragma once

#include <string>
#include <string_view>

namespace nezumi::record {

/// The same text always gives the same bytes. "" if there is no memory for it.
std::string gzipped(std::string_view text);

}  // namespace nezumi::record

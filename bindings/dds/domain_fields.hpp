// Common fields of `network` and `ros` in system files: the DDS domain, and the addresses of other hosts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/records/fields.hpp"

namespace nezumi::dds {

/// The largest domain number whose UDP ports exist (RTPS 2.5, 9.6.2.3).
inline constexpr std::int64_t last_domain = 232;

/// Checks that the field `peers` has addresses or names of hosts. Does not check whether such hosts exist.
void check_peers(FieldCheck& check, const std::vector<std::string>& peers);

/// The text of a list of names as a further field: ", peers = { \"a\", \"b\" }"; "" for none.
std::string names_text(std::string_view field, const std::vector<std::string>& names);

}  // namespace nezumi::dds

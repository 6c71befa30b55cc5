// Lists the contents of a domain as text.
#pragma once

#include <string>
#include <vector>

#include "bindings/dds/transport.hpp"
#include "bindings/dds/wire.hpp"

namespace nezumi::dds {

/// Returns a line for each host, then one for each topic of other programs, by name. "" for an empty domain.
std::string list_domain(const std::vector<const Announcement*>& hosts, const std::vector<SeenEndpoint>& seen);

}  // namespace nezumi::dds

// What there is in a domain, as lines for a person.
#pragma once

#include <string>
#include <vector>

#include "bindings/dds/transport.hpp"
#include "bindings/dds/wire.hpp"

namespace nezumi::dds {

/// A line for each host, then one for each topic that others have, by name. "" when there is nothing.
std::string list_domain(const std::vector<const Announcement*>& hosts, const std::vector<SeenEndpoint>& seen);

}  // namespace nezumi::dds

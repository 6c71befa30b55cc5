// Connections over the network, between ports named "host/name.port".
#pragma once

#include <string>
#include <utility>

namespace nezumi::dds {

/// The two ends of a connection between hosts: from, to.
using Ends = std::pair<std::string, std::string>;

}  // namespace nezumi::dds

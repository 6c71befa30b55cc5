// Connections on the network, between ports called "host/name.port".
#pragma once

#include <string>
#include <utility>

namespace nezumi::dds {

/// Both ends of a connection between two hosts: from, to.
using Ends = std::pair<std::string, std::string>;

}  // namespace nezumi::dds

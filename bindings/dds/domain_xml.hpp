// Cyclone's configuration for one domain: nothing of it comes from the environment or from a file.
#pragma once

#include <string>
#include <vector>

namespace nezumi::dds {

/// The configuration for a place in a domain.
///   Without an interface it is the loopback's, where processes find each other by asking every port.
///   With one, hosts find each other by multicast, and those at `peers` without; data goes from host to host, since
///   Wi-Fi sends what is for all at its lowest rate.
std::string domain_xml(const std::string& interface, const std::vector<std::string>& peers);

}  // namespace nezumi::dds

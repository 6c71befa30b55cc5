// The configuration of Cyclone DDS for one domain. Nothing comes from the environment or a file.
#pragma once

#include <string>
#include <vector>

namespace nezumi::dds {

/// Returns the configuration for a participant in a domain.
/// If `interface` is "", the participant uses the loopback, and processes find each other by asking every port.
/// With an interface, hosts find each other by multicast, and those in `peers` without it. Data are sent by unicast,
/// because Wi-Fi sends multicast at its lowest rate.
std::string domain_xml(const std::string& interface, const std::vector<std::string>& peers);

}  // namespace nezumi::dds

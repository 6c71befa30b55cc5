// Makes connections with other programs' RTCs, and finds the names of connections that others have made.
#pragma once

#include <optional>
#include <string>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_servers.hpp"
#include "bindings/openrtm/orb/port_object.hpp"

namespace nezumi::openrtm {

/// Connects a port of ours with one of another program's RTC. Returns "" if they are connected now, otherwise the
/// reason. May wait for the other RTC for some seconds. `theirs` gets the other port.
std::string link(NameServers& names, PortObject& ours, const RtcLink& wanted, RTC::PortService_var& theirs);

/// Describes a connection of our port `path` with another program's port, with the names that a system file uses.
/// Nothing if the RTC of the other port can't be found out. May wait for some seconds.
std::optional<RtcLink> link_with(NameServers& names, const std::string& path, RTC::PortService_ptr theirs);

}  // namespace nezumi::openrtm

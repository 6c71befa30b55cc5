// The connections requested by the system's file, which are made when the other RTC is there; and those made by others.
#pragma once

#include <optional>
#include <string>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_servers.hpp"
#include "bindings/openrtm/orb/port_object.hpp"

namespace nezumi::openrtm {

/// Connects a port of ours with one of another program's RTC. Returns "" if they are connected now, otherwise the
/// reason. May wait for the peer for some seconds. `theirs` gets the other port.
std::string link(NameServers& names, PortObject& ours, const RtcLink& wanted, RTC::PortService_var& theirs);

/// A connection of our port `path` with another program's port, as a system file names it. Nothing if the port does not
/// say whose it is. May wait for some seconds.
std::optional<RtcLink> link_with(NameServers& names, const std::string& path, RTC::PortService_ptr theirs);

}  // namespace nezumi::openrtm

// Makes the connections requested by the system's file, when the other RTC is there.
#pragma once

#include <string>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_service.hpp"
#include "bindings/openrtm/orb/port_object.hpp"

namespace nezumi::openrtm {

/// Connects a port of ours with one of another program's RTC. Returns "" if they are connected now, otherwise the
/// reason. May wait for the peer for some seconds. `theirs` gets the other port.
std::string link(NameService& names, PortObject& ours, const RtcLink& wanted, RTC::PortService_var& theirs);

}  // namespace nezumi::openrtm

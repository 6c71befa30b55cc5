// The connections that the system's file wants: made when the other RTC is there, and made again.
#pragma once

#include <string>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_service.hpp"
#include "bindings/openrtm/orb/port_object.hpp"

namespace nezumi::openrtm {

/// Makes a connection between a port of ours and one of another program's RTC. Returns "" when there is one now, else
/// why not. May wait for the peer for some seconds. `theirs` is the other port then.
std::string link(NameService& names, PortObject& ours, const RtcLink& wanted, RTC::PortService_var& theirs);

}  // namespace nezumi::openrtm

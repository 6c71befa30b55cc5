// What is asked of other programs' RTCs, as tools of OpenRTM-aist ask.
#pragma once

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_service.hpp"

namespace nezumi::openrtm {

/// How an RTC is, and with its configuration when `whole`. One that is gone, or silent, costs a second at most.
PeerSnapshot look_at(const NameService::Named& named, bool whole);

/// Has an RTC do something, and looks at it then. May throw CORBA's exceptions: it is gone, or does not answer.
PeerAnswer perform(const NameService::Named& named, const RtcRequest& request);

/// How often [Hz] the RTC of a port executes; 0 where it does not say. May wait for it.
double execution_rate(RTC::PortService_ptr port);

}  // namespace nezumi::openrtm

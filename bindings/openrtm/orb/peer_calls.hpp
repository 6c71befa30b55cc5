// Requests to other programs' RTCs, as OpenRTM-aist's tools make them.
#pragma once

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_service.hpp"

namespace nezumi::openrtm {

/// The state of an RTC, with its configuration if `whole`. A missing or silent RTC costs at most a second.
PeerSnapshot look_at(const NameService::Named& named, bool whole);

/// Executes a request and then reads the RTC's state. Throws CORBA's exceptions if the RTC is gone or silent.
PeerAnswer perform(const NameService::Named& named, const RtcRequest& request);

/// The execution rate [Hz] of a port's RTC; 0 if it gives none. May wait for it.
double execution_rate(RTC::PortService_ptr port);

}  // namespace nezumi::openrtm

// Requests to other programs' RTCs, as OpenRTM-aist's tools make them.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/name_service.hpp"

namespace nezumi::openrtm {

/// The state of an RTC, with its configuration if `whole`. A missing or silent RTC costs at most a second.
PeerSnapshot look_at(const NameService::Named& named, bool whole);

/// Executes a request and then reads the RTC's state. Throws CORBA's exceptions if the RTC is gone or silent.
PeerAnswer perform(const NameService::Named& named, const RtcRequest& request);

struct PeerPort {
    NameService::Named rtc{};
    std::string port{};  ///< "out"
};

/// Connects two ports, or ends their connection, as requested. It is not an error if this was done before. May wait for
/// some seconds.
PeerAnswer connect_peers(const std::array<PeerPort, 2>& ends, const RtcRequest& request);

/// Why a port refused a connection; "" if it accepted.
std::string_view connection_problem(RTC::ReturnCode_t code);

/// The port of an RTC with this name; nil if there is none. Throws CORBA's exceptions if the RTC is gone or silent.
RTC::PortService_ptr find_port(RTC::RTObject_ptr rtc, std::string_view port);

/// The execution rate [Hz] of a port's RTC; 0 if it gives none. May wait for it.
double execution_rate(RTC::PortService_ptr port);

}  // namespace nezumi::openrtm

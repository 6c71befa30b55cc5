// Settings of OpenRTM in a system file: the exported components, and the ports of RTCs in connections.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi::openrtm {

/// The port of CORBA's name services, assigned by IANA.
inline constexpr std::string_view usual_port = ":2809";

/// `rtm { nameserver, export, interface, rename, manager }`.
struct RtmSpec {
    std::vector<std::string> nameservers{"localhost:2809"};  ///< "HOST:PORT" of CORBA name services, not empty
    std::vector<std::string> exported{};                     ///< names of components that are exported as RTCs
    std::string interface = "127.0.0.1";                     ///< address of these RTCs
    ParameterValues rename{};                                ///< texts: what RTCs call a port, by "name.port"
    bool manager = false;                                    ///< tools may add and remove behaviours, and end the run
    Place place{};
};

/// A port of an RTC of another program: "rtm:pc.host_cxt/RaspberryPiMouse0.target_velocity_in".
struct RtmPath {
    std::string component;  ///< "RaspberryPiMouse0", or with its contexts "pc.host_cxt/RaspberryPiMouse0"
    std::string port;       ///< "target_velocity_in"
    bool operator==(const RtmPath&) const = default;
};

/// True if an end of a connection is a port of another program's RTC.
bool is_rtm_path(std::string_view end);
/// Parses the name of such a port. The error says what was expected.
Expected<RtmPath> rtm_path(std::string_view end);

/// Converts "localhost" to "localhost:2809"; returns the error, or "".
std::string adopt_nameserver(std::string& text);
/// Checks that this is an IPv4 address in digits; returns the error, or "".
std::string adopt_interface(std::string& text);

}  // namespace nezumi::openrtm

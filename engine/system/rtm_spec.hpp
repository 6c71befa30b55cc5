// What a system file says of OpenRTM's components: which of ours they see, and to which of theirs ports are connected.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"

namespace nezumi {

/// `rtm { nameserver, export, interface, rename }`.
struct RtmSpec {
    std::string nameserver = "localhost:2809";  ///< "HOST:PORT" of a CORBA name service
    std::vector<std::string> exported{};        ///< names of components that are RTCs there
    std::string interface = "127.0.0.1";        ///< address at which they are reached
    ParameterValues rename{};                   ///< texts: what a port is called there, by "name.port"
    Place place{};
};

/// A port of another program's RTC: "rtm:pc.host_cxt/RaspberryPiMouse0.target_velocity_in".
struct RtmPath {
    std::string component;  ///< "RaspberryPiMouse0", or with its contexts "pc.host_cxt/RaspberryPiMouse0"
    std::string port;       ///< "target_velocity_in"
    bool operator==(const RtmPath&) const = default;
};

/// Whether an end of a connection is a port of another program's RTC.
bool is_rtm_path(std::string_view end);
/// An end that is. The error says what was expected.
Expected<RtmPath> rtm_path(std::string_view end);

/// "localhost" and "localhost:2809": brought into the second form, or why it can't be.
std::string adopt_nameserver(std::string& text);
/// An IPv4 address in digits, or why it is none.
std::string adopt_interface(std::string& text);

}  // namespace nezumi

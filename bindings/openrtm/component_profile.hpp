// A component's profile: its declarations in RTCBuilder's file format (RTC.xml, versions 0.1 to 0.3).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/components/parameter.hpp"
#include "engine/ports/port_base.hpp"

namespace nezumi::openrtm {

struct ProfilePort {
    Direction direction = Direction::in;
    std::string name;
    std::string type;      ///< of its messages, without OpenRTM's module: "TimedShortSeq"; "Img/CameraImage"
    std::string idl_file;  ///< the IDL file that defines the type; may be empty
    std::string doc;
    std::size_t queue = 0;  ///< of an in-port: 0 for the latest message only
    std::string safe;       ///< of an out-port: its safe value in JSON; "" for none
};

struct ComponentProfile {
    std::string name;
    std::string doc;  ///< one line or several
    std::string version, vendor, category;
    double rate = 0;                     ///< [Hz] of executions; 0: not given
    std::vector<std::string> callbacks;  ///< the implemented ones, in the order of the profile: "on_activated", ...
    std::vector<ProfilePort> ports;      ///< in the order of the profile
    std::vector<ParameterSpec> parameters;
    /// Parts of the profile that nezumi can't use, one line each: "service port 'map': requires RTC::OGMapServer".
    std::vector<std::string> remarks;
};

/// Reads the text of a profile. `shown` is the file's name in errors. Parts that can't be used become remarks. An error
/// if the text is not a profile, or if RTCBuilder can't have written it: with a DOCTYPE, or with more than 100 nested
/// elements.
Expected<ComponentProfile> read_component_profile(std::string_view text, const std::string& shown);

/// Writes a profile of version 0.3 that was changed at `date` ("2026-01-31T12:00:00Z"). Reading the text gives the
/// same profile, except for the field `remarks`. An error names the text that XML can't hold.
Expected<std::string> write_component_profile(const ComponentProfile& profile, const std::string& date);

}  // namespace nezumi::openrtm

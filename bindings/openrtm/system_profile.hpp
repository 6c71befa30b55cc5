// A system's profile: components, their configuration and connections in RTSystemEditor's file format (RtsProfile, in
// XML or YAML).
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/system/system.hpp"
#include "engine/system/system_spec.hpp"

namespace nezumi::openrtm {

struct ProfiledComponent {
    std::string type;      ///< "RobotController"
    std::string instance;  ///< "RobotController0"
    std::string set;       ///< the active configuration set: "default"; may be empty
    double rate = 0;       ///< [Hz] of its first execution context; 0: not given
    std::string vendor{}, category{}, version{};
    std::string path{};                ///< in the name service: "localhost/pc.host_cxt/RobotController0.rtc"
    bool is_required = true;           ///< the system does not work without it
    std::vector<std::string> ports{};  ///< names of the data ports, without the instance's name
    /// Configuration sets by name, with the texts of their values by parameter.
    std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> sets{};
};

struct ProfiledEnd {
    std::string instance, port;  ///< "RobotController0", "out"
    std::string path{};          ///< of its component, as above; may be empty
};

struct ProfiledConnection {
    ProfiledEnd from, to;
    std::string type;    ///< "IDL:RTC/TimedShortSeq:1.0"; may be empty
    std::string name{};  ///< "RobotController0.out_Mouse0.in"; may be empty
    std::string id{};    ///< may be empty
    /// Texts by name: "dataport.dataflow_type" and others. None is a reference to an object.
    std::vector<std::pair<std::string, std::string>> properties{};
};

struct SystemProfile {
    std::string name;  ///< of the system; may be empty
    std::string doc;   ///< lines; may be empty
    std::vector<ProfiledComponent> components;
    std::vector<ProfiledConnection> connections;          ///< of data ports
    std::vector<ProfiledConnection> service_connections;  ///< of service ports; without types
    std::vector<std::string> remarks;                     ///< parts that nezumi can't use, one line each
};

/// The component at an end of a connection; nullptr if the profile has none.
const ProfiledComponent* component_at(const SystemProfile& profile, const ProfiledEnd& end);

enum class ProfileFormat { xml, yaml };

/// Reads the text of a profile, XML or YAML; `shown` is the file's name in errors. Hostile texts are refused as by
/// `read_component_profile`.
Expected<SystemProfile> read_system_profile(std::string_view text, const std::string& shown);

/// The profile of a running system: its components as RTCs, and the RTCs of other programs that it is connected to.
SystemProfile profile_of_system(const System& system, const SystemSpec& spec);

/// Writes a profile of version 0.2 that was changed at `date` ("2026-01-31T12:00:00", without a zone for
/// rtsprofile). Reading the text gives the same profile, except for the field `remarks`. An error names the text that a
/// profile can't hold.
Expected<std::string> write_system_profile(const SystemProfile& profile, const std::string& date,
                                           ProfileFormat format = ProfileFormat::xml);

}  // namespace nezumi::openrtm

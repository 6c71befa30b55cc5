// Finds a port by the name of its RTC and checks that it fits.
#include "bindings/openrtm/orb/linker.hpp"

#include "bindings/openrtm/orb/peer_calls.hpp"
#include "bindings/openrtm/orb/properties.hpp"
#include "bindings/openrtm/orb/terms.hpp"

namespace nezumi::openrtm {
namespace {

// Returns why a port with this profile can't be connected to ours, or "".
std::string misfit(const PortObject& ours, const RTC::PortProfile& theirs) {
    const bool is_in = text_of(theirs.properties, "port.port_type") == "DataInPort";
    const std::string type = data_type_of(theirs);
    if (is_in == ours.port().is_in) return is_in ? "both are in-ports" : "both are out-ports";
    if (type != ours.port().type)
        return "it carries " + type + ", and " + ours.port().path + " carries " + ours.port().type;
    return "";
}

std::string connect(PortObject& ours, const RtcLink& wanted, RTC::PortService_ptr theirs) {
    if (!ours.connection_with(theirs).empty()) return "";
    const RTC::PortService_var self = ours._this();
    RTC::ConnectorProfile profile;
    const std::string other = wanted.component + "." + wanted.port;
    profile.name = corba_text(ours.port().is_in ? other + "_" + wanted.path : wanted.path + "_" + other);
    profile.connector_id = corba_text("");
    profile.ports.length(2);
    profile.ports[0] = RTC::PortService::_duplicate(self);
    profile.ports[1] = RTC::PortService::_duplicate(theirs);
    add_own_terms(profile.properties, ours.port().type_id());
    return std::string(connection_problem(ours.connect(profile)));
}

// The name by which the name services find an RTC: the short one if it is enough. If no name finds it, the name that
// the RTC itself gives.
std::string name_of(NameServers& names, RTC::RTObject_ptr rtc, const std::string& instance, std::string registered) {
    registered = registered.substr(0, registered.find(','));  // an RTC may have several names
    if (const std::string_view kind = ".rtc"; registered.ends_with(kind))
        registered.resize(registered.size() - kind.size());
    for (const std::string& name : {instance, registered}) {
        const auto found = name.empty() ? Expected<NameService::Named>(failure("")) : names.find(name);
        if (found && found->rtc->_is_equivalent(rtc)) return name;
    }
    return registered.empty() ? instance : registered;
}

}  // namespace

std::optional<RtcLink> link_with(NameServers& names, const std::string& path, RTC::PortService_ptr theirs) {
    try {
        const RTC::PortProfile_var port = theirs->get_port_profile();
        if (CORBA::is_nil(port->owner)) return std::nullopt;
        const RTC::ComponentProfile_var rtc = port->owner->get_component_profile();
        const std::string instance = rtc->instance_name.in();
        std::string name = port->name.in();
        if (name.starts_with(instance + ".")) name.erase(0, instance.size() + 1);
        return RtcLink{path, name_of(names, port->owner, instance, text_of(rtc->properties, "naming.names")), name};
    } catch (const CORBA::Exception&) {
        return std::nullopt;
    }
}

std::string link(NameServers& names, PortObject& ours, const RtcLink& wanted, RTC::PortService_var& theirs) {
    Expected<NameService::Named> found;
    try {
        found = names.find(wanted.component);
    } catch (const CORBA::Exception&) {
        return "no name service answers at " + names.addresses();
    }
    if (!found) return found.error().message;
    try {
        const RTC::PortService_var port = find_port(found->rtc, wanted.port);
        if (CORBA::is_nil(port)) return "the RTC has no port '" + wanted.port + "'";
        const RTC::PortProfile_var profile = port->get_port_profile();
        std::string problem = misfit(ours, profile.in());
        if (problem.empty()) problem = connect(ours, wanted, port);
        if (problem.empty()) theirs = port;
        return problem;
    } catch (const CORBA::TIMEOUT&) {
        return "the RTC does not answer";
    } catch (const CORBA::Exception&) {
        return "its entry in the name service is stale: the RTC was not found";
    }
}

}  // namespace nezumi::openrtm

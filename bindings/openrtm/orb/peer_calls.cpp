// Requests go to an RTC's first execution context, because that is the one that executes it.
#include "bindings/openrtm/orb/peer_calls.hpp"

#include <algorithm>
#include <utility>

#include "bindings/openrtm/orb/properties.hpp"
#include "bindings/openrtm/orb/terms.hpp"
#include "engine/base/list.hpp"

namespace nezumi::openrtm {
namespace {

Texts texts_of(const SDOPackage::NVList& list) {
    Texts texts;
    for (CORBA::ULong i = 0; i < list.length(); ++i) texts.emplace_back(list[i].name.in(), text_of(list[i].value));
    return texts;
}

// The first execution context of an RTC; nil if there is none.
RTC::ExecutionContext_ptr context_of(RTC::RTObject_ptr rtc) {
    RTC::ExecutionContextList_var contexts = rtc->get_owned_contexts();
    if (contexts->length() == 0) return RTC::ExecutionContext::_nil();
    return RTC::ExecutionContext::_duplicate(contexts[0]);
}

PeerSnapshot::State state_of(RTC::LifeCycleState state) {
    switch (state) {
        case RTC::CREATED_STATE: return PeerSnapshot::State::created;
        case RTC::INACTIVE_STATE: return PeerSnapshot::State::inactive;
        case RTC::ACTIVE_STATE: return PeerSnapshot::State::active;
        case RTC::ERROR_STATE: return PeerSnapshot::State::error;
    }
    return PeerSnapshot::State::unknown;
}

void look_at_state(PeerSnapshot& snapshot, RTC::RTObject_ptr rtc) {
    const RTC::ExecutionContext_var context = context_of(rtc);
    if (CORBA::is_nil(context)) return;
    snapshot.state = state_of(context->get_component_state(rtc));
    snapshot.is_stopped = !context->is_running();
}

PeerSnapshot::Port look_at(const RTC::PortProfile& profile) {
    std::string name = profile.name.in();
    name.erase(0, name.rfind('.') + 1);  // "ConsoleOut0.out"
    PeerSnapshot::Port port{.name = std::move(name),
                            .type = data_type_of(profile),
                            .is_in = text_of(profile.properties, "port.port_type") == "DataInPort"};
    for (CORBA::ULong i = 0; i < profile.connector_profiles.length(); ++i)
        port.connections.emplace_back(profile.connector_profiles[i].connector_id.in());
    return port;
}

void look_at_sets(PeerSnapshot& snapshot, RTC::RTObject_ptr rtc) {
    try {
        const SDOPackage::Configuration_var configuration = rtc->get_configuration();
        if (CORBA::is_nil(configuration)) return;
        SDOPackage::ConfigurationSetList_var sets = configuration->get_configuration_sets();
        for (CORBA::ULong i = 0; i < sets->length(); ++i)
            snapshot.sets.emplace_back(sets[i].id.in(), texts_of(sets[i].configuration_data));
        const SDOPackage::ConfigurationSet_var active = configuration->get_active_configuration_set();
        snapshot.set = active->id.in();
    } catch (const CORBA::UserException&) {
        return;  // the RTC has no configuration
    }
}

std::string problem_of(RTC::ReturnCode_t code) {
    switch (code) {
        case RTC::RTC_OK: return "";
        case RTC::PRECONDITION_NOT_MET: return "its state does not allow that (PRECONDITION_NOT_MET)";
        case RTC::BAD_PARAMETER: return "its execution context does not run it (BAD_PARAMETER)";
        case RTC::UNSUPPORTED: return "it can't do that (UNSUPPORTED)";
        case RTC::OUT_OF_RESOURCES: return "it refuses that (OUT_OF_RESOURCES)";
        case RTC::RTC_ERROR: break;
    }
    return "it refuses that (RTC_ERROR)";
}

std::string change_state(RTC::RTObject_ptr rtc, RtcRequest::What what) {
    if (what == RtcRequest::What::exit) return problem_of(rtc->exit());
    const RTC::ExecutionContext_var context = context_of(rtc);
    if (CORBA::is_nil(context)) return "it has no execution context";
    const RTC::ReturnCode_t code = what == RtcRequest::What::activate     ? context->activate_component(rtc)
                                   : what == RtcRequest::What::deactivate ? context->deactivate_component(rtc)
                                                                          : context->reset_component(rtc);
    if (code == RTC::PRECONDITION_NOT_MET && context->get_component_state(rtc) == RTC::ERROR_STATE)
        return "it is in ERROR: reset it (PRECONDITION_NOT_MET)";
    if (code != RTC::RTC_ERROR) return problem_of(code);
    // OpenRTM-aist waits half a second for the new state, and keeps the request while an execution lasts.
    return context->is_running() ? "its execution takes long, so it may follow later (RTC_ERROR)"
                                 : "its execution context is stopped: start that first (RTC_ERROR)";
}

template <class Pairs>
std::vector<std::string> names_of(const Pairs& pairs) {
    std::vector<std::string> names;
    names.reserve(pairs.size());
    for (const auto& [name, value] : pairs) names.push_back(name);
    return names;
}

// A changed value takes effect when the set is activated again.
PeerAnswer configure(RTC::RTObject_ptr rtc, const RtcRequest& request) {
    PeerSnapshot snapshot;
    look_at_sets(snapshot, rtc);
    const std::string set = request.set.empty() ? snapshot.set : request.set;
    const auto found =
        std::find_if(snapshot.sets.begin(), snapshot.sets.end(), [&](const auto& each) { return each.first == set; });
    if (snapshot.sets.empty()) return {.problem = "it has no configuration"};
    if (found == snapshot.sets.end())
        return {
            .problem = "it has no configuration set '" + set + "'", .missing = set, .known = names_of(snapshot.sets)};
    const SDOPackage::Configuration_var configuration = rtc->get_configuration();
    if (request.what == RtcRequest::What::set) {
        SDOPackage::ConfigurationSet values;
        values.id = corba_text(set);
        values.description = corba_text("");
        const std::vector<std::string> names = names_of(found->second);
        for (const auto& [name, text] : request.values) {
            if (!contains(names, name))
                return {.problem = "it has no parameter '" + name + "'", .missing = name, .known = names};
            add_text(values.configuration_data, name, text);
        }
        if (!configuration->set_configuration_set_values(values)) return {.problem = "it refuses these values"};
    }
    if (!configuration->activate_configuration_set(set.c_str())) return {.problem = "it refuses the set '" + set + "'"};
    return {};
}

// The id of a connection of these two ports; "" if there is none.
std::string connection_between(RTC::PortService_ptr one, RTC::PortService_ptr other) {
    RTC::ConnectorProfileList_var all = one->get_connector_profiles();
    for (CORBA::ULong i = 0; i < all->length(); ++i) {
        const RTC::PortServiceList& ports = all[i].ports;
        for (CORBA::ULong j = 0; j < ports.length(); ++j) {
            if (ports[j]->_is_equivalent(other)) return all[i].connector_id.in();
        }
    }
    return "";
}

// Adds the usual terms to a connection between data ports if the request gives none.
void add_usual_terms(RTC::ConnectorProfile& connection) {
    const RTC::PortProfile_var port = connection.ports[0]->get_port_profile();
    const std::string type = text_of(port->properties, "dataport.data_type");
    if (!type.empty()) add_own_terms(connection.properties, type);
}

std::string prefixed(const std::string& at, std::string_view problem) {
    return problem.empty() ? "" : at + ": " + std::string(problem);
}

}  // namespace

PeerSnapshot look_at(const NameService::Named& named, bool whole) {
    PeerSnapshot snapshot{.name = named.name};
    RTC::RTObject_ptr rtc = named.rtc.in();
    try {
        const RTC::ComponentProfile_var profile = rtc->get_component_profile();
        snapshot.type = profile->type_name.in();
        RTC::PortServiceList_var ports = rtc->get_ports();
        for (CORBA::ULong i = 0; i < ports->length(); ++i) {
            const RTC::PortProfile_var port = ports[i]->get_port_profile();
            snapshot.ports.push_back(look_at(port.in()));
        }
        look_at_state(snapshot, rtc);
        if (whole) look_at_sets(snapshot, rtc);
    } catch (const CORBA::TIMEOUT&) {
        snapshot.state = PeerSnapshot::State::silent;
    } catch (const CORBA::Exception&) {
        snapshot.state = PeerSnapshot::State::gone;
    }
    return snapshot;
}

PeerAnswer perform(const NameService::Named& named, const RtcRequest& request) {
    RTC::RTObject_ptr rtc = named.rtc.in();
    PeerAnswer answer;
    try {
        if (request.what == RtcRequest::What::use || request.what == RtcRequest::What::set) {
            answer = configure(rtc, request);
        } else {
            answer.problem = change_state(rtc, request.what);
        }
    } catch (const CORBA::UserException& error) {
        answer.problem = std::string("it refuses that (") + error._name() + ")";
    }
    const bool is_there = request.what != RtcRequest::What::exit;
    if (answer.problem.empty() && is_there) answer.peers.push_back(look_at(named, false));
    return answer;
}

// Ports of an RTC are named "ConsoleOut0.out".
RTC::PortService_ptr find_port(RTC::RTObject_ptr rtc, std::string_view port) {
    RTC::PortServiceList_var ports = rtc->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        const RTC::PortProfile_var profile = ports[i]->get_port_profile();
        std::string_view name = profile->name.in();
        if (name == port ||
            (name.size() > port.size() && name.ends_with(port) && name[name.size() - port.size() - 1] == '.'))
            return RTC::PortService::_duplicate(ports[i]);
    }
    return RTC::PortService::_nil();
}

std::string_view connection_problem(RTC::ReturnCode_t code) {
    switch (code) {
        case RTC::RTC_OK: return "";
        case RTC::BAD_PARAMETER: return "it does not accept the connection's type or properties (BAD_PARAMETER)";
        case RTC::UNSUPPORTED: return "it does not support that (UNSUPPORTED)";
        case RTC::OUT_OF_RESOURCES: return "it has too many connections (OUT_OF_RESOURCES)";
        case RTC::PRECONDITION_NOT_MET: return "it says that they are connected already (PRECONDITION_NOT_MET)";
        case RTC::RTC_ERROR: break;
    }
    return "it refuses the connection (RTC_ERROR)";
}

PeerAnswer connect_peers(const std::array<PeerPort, 2>& ends, const RtcRequest& request) {
    const bool connects = request.what == RtcRequest::What::connect;
    RTC::ConnectorProfile profile;
    profile.name = corba_text(request.component);
    profile.connector_id = corba_text(request.id);
    profile.ports.length(2);
    std::string at;
    try {
        for (std::size_t i = 0; i < ends.size(); ++i) {
            at = "rtm:" + ends[i].rtc.name;
            const RTC::PortService_var port = find_port(ends[i].rtc.rtc, ends[i].port);
            if (CORBA::is_nil(port)) return {.problem = at + ": it has no port '" + ends[i].port + "'"};
            profile.ports[static_cast<CORBA::ULong>(i)] = port;
        }
        at = "rtm:" + ends[0].rtc.name;
        std::string made = connection_between(profile.ports[0], profile.ports[1]);
        if (made.empty() != connects) {
            return connects ? PeerAnswer{.was_so = true} : PeerAnswer{.problem = at + ": they are not connected"};
        }
        if (!connects) return {.problem = prefixed(at, connection_problem(profile.ports[0]->disconnect(made.c_str())))};
        for (const auto& [name, value] : request.values) add_text(profile.properties, name, value);
        if (request.values.empty()) add_usual_terms(profile);
        return {.problem = prefixed(at, connection_problem(profile.ports[0]->connect(profile)))};
    } catch (const CORBA::TIMEOUT&) {
        return {.problem = at + " does not answer"};
    } catch (const CORBA::Exception&) {
        return {.problem = at + " was not found: its entry in the name service is stale"};
    }
}

double execution_rate(RTC::PortService_ptr port) {
    try {
        const RTC::PortProfile_var profile = port->get_port_profile();
        if (CORBA::is_nil(profile->owner)) return 0;
        const RTC::ExecutionContext_var context = context_of(profile->owner);
        return CORBA::is_nil(context) ? 0 : context->get_rate();
    } catch (const CORBA::Exception&) {
        return 0;
    }
}

}  // namespace nezumi::openrtm

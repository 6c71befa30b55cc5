// Shows connections between two ports of this system to RTCs and tools. The system itself makes these connections and
// carries their messages.
#include <algorithm>

#include "bindings/openrtm/orb/port_object.hpp"
#include "bindings/openrtm/orb/properties.hpp"
#include "bindings/openrtm/orb/servants.hpp"
#include "bindings/openrtm/orb/terms.hpp"
#include "engine/base/list.hpp"

namespace nezumi::openrtm {
namespace {

// A connection that a tool has made is shown immediately. For this time it stays, even if the system's list, which may
// be older, lacks it.
constexpr std::chrono::seconds grace{2};

}  // namespace

// The other port of a connection between two ports, if both belong to this system.
PortableServer::Servant_var<PortObject> PortObject::port_of_ours(const RTC::ConnectorProfile& profile) {
    if (profile.ports.length() != 2) return {};
    const CORBA::ULong other = is_self(profile.ports[0]) ? 1 : 0;
    if (!is_self(profile.ports[1 - other]) || CORBA::is_nil(profile.ports[other])) return {};
    try {
        const PortableServer::POA_var poa = _default_POA();
        const PortableServer::ServantBase_var servant = poa->reference_to_servant(profile.ports[other]);
        auto* port = dynamic_cast<PortObject*>(servant.in());
        if (port == nullptr || port == this || &port->home_.site != &home_.site) return {};
        port->_add_ref();
        return port;
    } catch (const CORBA::Exception&) {
        return {};  // of another program
    }
}

void PortObject::add_inside(const std::string& other, const RTC::ConnectorProfile& profile) {
    const std::lock_guard lock(mutex_);
    inside_.try_emplace(other, Inside{profile, std::chrono::steady_clock::now()});
}

void PortObject::keep_inside(const std::vector<std::string>& others) {
    const auto now = std::chrono::steady_clock::now();
    const std::lock_guard lock(mutex_);
    std::erase_if(inside_,
                  [&](const auto& each) { return now - each.second.made > grace && !contains(others, each.first); });
}

void PortObject::show_inside(PortObject& from, PortObject& to) {
    RTC::ConnectorProfile profile;
    {
        const std::lock_guard lock(from.mutex_);
        if (from.inside_.contains(to.port_.path)) return;
    }
    profile.name = corba_text(from.name_ + "_" + to.name_);
    profile.connector_id = corba_text(new_id());
    profile.ports.length(2);
    profile.ports[0] = RTC::PortService::_duplicate(from.self_);
    profile.ports[1] = RTC::PortService::_duplicate(to.self_);
    add_own_terms(profile.properties, from.port_.type_id());
    from.add_inside(to.port_.path, profile);
    to.add_inside(from.port_.path, profile);
}

RTC::ReturnCode_t PortObject::request_inside(RtcRequest::What what, const std::string& other) {
    const std::string& own = port_.path;
    return code_of(home_.site.perform({.what = what,
                                       .component = own.substr(0, own.find('.')),
                                       .from = port_.is_in ? other : own,
                                       .to = port_.is_in ? own : other}));
}

RTC::ReturnCode_t PortObject::connect_inside(const RTC::ConnectorProfile& profile, PortObject& other) {
    if (other.port_.is_in == port_.is_in || other.port_.type_id() != port_.type_id()) return RTC::BAD_PARAMETER;
    const RTC::ReturnCode_t made = request_inside(RtcRequest::What::connect, other.port_.path);
    if (made != RTC::RTC_OK) return made;
    add_inside(other.port_.path, profile);
    other.add_inside(port_.path, profile);
    return made;
}

// Ends the connection with this id; returns nothing if there is none.
std::optional<RTC::ReturnCode_t> PortObject::disconnect_inside(const std::string& id) {
    std::string path;
    RTC::ConnectorProfile profile;
    {
        const std::lock_guard lock(mutex_);
        const auto found = std::find_if(inside_.begin(), inside_.end(),
                                        [&](const auto& each) { return each.second.profile.connector_id.in() == id; });
        if (found == inside_.end()) return std::nullopt;
        path = found->first;
        profile = found->second.profile;
    }
    const RTC::ReturnCode_t done = request_inside(RtcRequest::What::disconnect, path);
    if (done == RTC::RTC_ERROR) return done;
    const auto forget = [](PortObject& port, const std::string& other) {
        const std::lock_guard lock(port.mutex_);
        port.inside_.erase(other);
    };
    forget(*this, path);
    if (const auto other = port_of_ours(profile); other.in() != nullptr) forget(*other.in(), port_.path);
    return done;
}

}  // namespace nezumi::openrtm

// Connecting is a chain: each port adds its properties, calls the next port, and on return uses the properties of the
// others.
#include "bindings/openrtm/orb/port_object.hpp"

#include <sys/random.h>

#include <array>
#include <thread>
#include <utility>

#include "bindings/openrtm/orb/life.hpp"
#include "bindings/openrtm/orb/properties.hpp"
#include "bindings/openrtm/orb/servants.hpp"

namespace nezumi::openrtm {
namespace {

SDOPackage::NVList properties_of(const RtcPort& port) {
    SDOPackage::NVList list;
    add_text(list, "port.port_type", port.is_in ? "DataInPort" : "DataOutPort");
    add_text(list, "dataport.data_type", port.type_id());
    add_text(list, "dataport.interface_type", "corba_cdr");
    add_text(list, "dataport.dataflow_type", "push,pull");
    add_text(list, "dataport.subscription_type", port.is_in ? "Any" : "flush,new,periodic");
    add_text(list, "dataport.marshaling_types", "cdr");
    add_text(list, "dataport.serializer.cdr.endian", "little,big");
    return list;
}

// Limits a connection's profile, which is stored, because the client chooses all its texts.
bool is_short(const RTC::ConnectorProfile& profile) {
    const auto fits = [](const char* text) { return std::string_view(text).size() <= PortObject::most_letters; };
    if (!fits(profile.name.in()) || !fits(profile.connector_id.in())) return false;
    cdrMemoryStream bytes;
    profile >>= bytes;
    return bytes.bufSize() <= PortObject::most_bytes;
}

// A peer whose messages are fetched should report an empty buffer instead of repeating the last message. This works
// only if its buffer is made later; and a property set by the client is not changed.
void ask_for_empty_answers(SDOPackage::NVList& properties) {
    constexpr const char* policy = "dataport.outport.buffer.read.empty_policy";
    const auto terms = terms_of(properties);
    if (terms && !terms->push && text_of(properties, policy).empty()) add_text(properties, policy, "do_nothing");
}

// The result of a call to a peer; a missing or hanging peer is an error.
template <class Call>
RTC::ReturnCode_t ask(const Call& call) {
    try {
        return call();
    } catch (const CORBA::Exception&) {
        return RTC::RTC_ERROR;
    }
}

}  // namespace

std::string new_id() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) < 0) return "";
    constexpr std::string_view digits = "0123456789abcdef";
    std::string id;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) id += '-';
        id += digits[bytes[i] >> 4];
        id += digits[bytes[i] & 15U];
    }
    return id;
}

PortObject::PortObject(const Home& home, RtcPort port)
    : home_(home), port_(std::move(port)), properties_(properties_of(port_)) {}

RTC::PortService_ptr PortObject::begin(RTC::RTObject_ptr owner, const std::string& instance) {
    owner_ = RTC::RTObject::_duplicate(owner);
    name_ = instance + "." + port_.name;
    self_ = _this();
    return RTC::PortService::_duplicate(self_);
}

void PortObject::withdraw(std::chrono::steady_clock::time_point deadline) {
    for (const std::string& id : ids()) static_cast<void>(disconnect(id, deadline));
    deactivate(*this);
}

void PortObject::stop() {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, connection] : connections_) {
        if (connection.connector != nullptr) connection.connector->stop();
    }
}

// Waits until robots have received their stop. An RTC never reads a message that is left in the buffer when the
// connection ends, so a robot would drive on.
void PortObject::settle(const std::string& id, std::chrono::steady_clock::time_point deadline) {
    constexpr std::chrono::milliseconds pause{5};
    const auto is_settled = [&] {
        const std::lock_guard lock(mutex_);
        const auto found = connections_.find(id);
        if (found == connections_.end() || found->second.connector == nullptr) return true;
        found->second.connector->stop();
        return found->second.connector->is_settled();
    };
    while (!is_settled() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(pause);
}

bool PortObject::is_self(RTC::PortService_ptr other) const {
    return !CORBA::is_nil(other) && self_->_is_equivalent(other);
}

WantedOrders PortObject::wanted() {
    const std::lock_guard lock(mutex_);
    WantedOrders orders;
    for (const auto& [id, connection] : connections_) {
        if (connection.connector == nullptr) continue;
        (connection.terms.order == std::endian::big ? orders.big : orders.little) = true;
    }
    return orders;
}

void PortObject::publish(std::span<const std::uint8_t> bytes, std::endian order) {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, connection] : connections_) {
        if (connection.connector != nullptr && connection.terms.order == order) connection.connector->publish(bytes);
    }
}

std::vector<std::string> PortObject::ids() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> all;
    for (const auto& [id, connection] : connections_) all.push_back(id);
    return all;
}

PortObject::Connection PortObject::take_away(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const auto found = connections_.find(id);
    if (found == connections_.end()) return {};
    Connection connection = std::move(found->second);
    connections_.erase(found);
    return connection;
}

// Call it without the lock: the connection's thread may wait for a peer that hangs.
void PortObject::end(Connection connection) {
    if (connection.connector == nullptr) return;
    connection.connector.reset();
    if (port_.is_in) home_.site.left(port_.path, inlet_of(connection.profile).from);
}

std::vector<PortObject::Made> PortObject::made() {
    const std::lock_guard lock(mutex_);
    std::vector<Made> all;
    for (const auto& [id, connection] : connections_) {
        const RTC::PortServiceList& ports = connection.profile.ports;
        for (CORBA::ULong i = 0; i < ports.length() && connection.connector != nullptr; ++i) {
            if (!is_self(ports[i])) all.push_back({id, RTC::PortService::_duplicate(ports[i])});
        }
    }
    return all;
}

std::vector<std::string> PortObject::drop_lost() {
    std::vector<std::string> lost;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [id, connection] : connections_) {
            if (connection.connector != nullptr && connection.connector->is_lost()) lost.push_back(id);
        }
    }
    for (const std::string& id : lost) end(take_away(id));
    return lost;
}

std::vector<std::string> PortObject::ask_peers(const std::function<bool()>& goes_on) {
    std::vector<std::string> lost;
    for (const std::string& id : ids()) {
        if (!goes_on()) break;
        RTC::PortServiceList ports;
        {
            const std::lock_guard lock(mutex_);
            const auto found = connections_.find(id);
            if (found == connections_.end() || found->second.connector == nullptr) continue;
            ports = found->second.profile.ports;
        }
        bool gone = false;
        for (CORBA::ULong i = 0; i < ports.length() && !gone; ++i)
            gone = !is_self(ports[i]) && life_of(ports[i]) == Life::gone;
        if (!gone) continue;
        end(take_away(id));
        lost.push_back(id);
    }
    return lost;
}

std::string PortObject::connection_with(RTC::PortService_ptr other) {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, connection] : connections_) {
        const RTC::PortServiceList& ports = connection.profile.ports;
        for (CORBA::ULong i = 0; i < ports.length(); ++i) {
            if (!CORBA::is_nil(ports[i]) && ports[i]->_is_equivalent(other)) return id;
        }
    }
    return "";
}

RTC::PortProfile* PortObject::get_port_profile() {
    RTC::PortProfile_var profile = new RTC::PortProfile;
    profile->port_ref = RTC::PortService::_duplicate(self_);
    profile->properties = properties_;
    const RTC::ConnectorProfileList_var connectors = get_connector_profiles();
    profile->connector_profiles = connectors.in();
    profile->name = corba_text(name_);
    profile->owner = RTC::RTObject::_duplicate(owner_);
    return profile._retn();
}

RTC::ConnectorProfileList* PortObject::get_connector_profiles() {
    RTC::ConnectorProfileList_var list = new RTC::ConnectorProfileList;
    const std::lock_guard lock(mutex_);
    for (const auto& [id, connection] : connections_) {
        if (connection.connector == nullptr) continue;
        list->length(list->length() + 1);
        list[list->length() - 1] = connection.profile;
    }
    for (const auto& [other, inside] : inside_) {
        list->length(list->length() + 1);
        list[list->length() - 1] = inside.profile;
    }
    return list._retn();
}

RTC::ConnectorProfile* PortObject::get_connector_profile(const char* id) {
    RTC::ConnectorProfile_var profile = new RTC::ConnectorProfile;
    const std::lock_guard lock(mutex_);
    const auto found = connections_.find(id);
    if (found != connections_.end()) profile = new RTC::ConnectorProfile(found->second.profile);
    for (const auto& [other, inside] : inside_) {
        if (std::string_view(inside.profile.connector_id.in()) == id)
            profile = new RTC::ConnectorProfile(inside.profile);
    }
    return profile._retn();
}

RTC::ReturnCode_t PortObject::connect(RTC::ConnectorProfile& connector) {
    if (connector.ports.length() == 0) return RTC::BAD_PARAMETER;
    if (connector.connector_id.in()[0] == '\0') connector.connector_id = corba_text(new_id());
    const std::string id = connector.connector_id.in();
    const RTC::PortService_var first = RTC::PortService::_duplicate(connector.ports[0]);
    if (CORBA::is_nil(first)) return RTC::BAD_PARAMETER;
    if (port_.is_in) ask_for_empty_answers(connector.properties);
    const RTC::ReturnCode_t connected =
        is_self(first) ? notify_connect(connector) : ask([&] { return first->notify_connect(connector); });
    return connected;
}

RTC::ReturnCode_t PortObject::disconnect(const char* id) {
    return disconnect(id, std::chrono::steady_clock::now() + longest_settling);
}

RTC::ReturnCode_t PortObject::disconnect(const std::string& id, std::chrono::steady_clock::time_point deadline) {
    if (const auto inside = disconnect_inside(id)) return *inside;
    settle(id, deadline);
    RTC::PortServiceList ports;
    {
        const std::lock_guard lock(mutex_);
        const auto found = connections_.find(id);
        if (found == connections_.end()) return RTC::BAD_PARAMETER;
        ports = found->second.profile.ports;
    }
    // The first port passes the call on to the others. If the first port is gone, each other port is called.
    RTC::ReturnCode_t told = RTC::RTC_ERROR;
    for (CORBA::ULong i = 0; i < ports.length() && told != RTC::RTC_OK; ++i) {
        if (CORBA::is_nil(ports[i])) continue;
        told = is_self(ports[i]) ? leave(id) : ask([&] { return ports[i]->notify_disconnect(id.c_str()); });
    }
    end(take_away(id));
    return told;
}

RTC::ReturnCode_t PortObject::disconnect_all() {
    RTC::ReturnCode_t all = RTC::RTC_OK;
    std::vector<std::string> every = ids();
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [other, inside] : inside_) every.emplace_back(inside.profile.connector_id.in());
    }
    for (const std::string& id : every) {
        if (const auto done = disconnect(id.c_str()); done != RTC::RTC_OK) all = done;
    }
    return all;
}

// Reserves the place, so that a second connection between the same ports is refused while this one is being made.
RTC::ReturnCode_t PortObject::reserve(const RTC::ConnectorProfile& profile, const Terms& terms) {
    const std::lock_guard one_at_a_time(reserving_);
    bool is_of_this = false;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        if (is_self(profile.ports[i])) {
            is_of_this = true;
        } else if (CORBA::is_nil(profile.ports[i])) {
            return RTC::BAD_PARAMETER;
        } else if (!connection_with(profile.ports[i]).empty()) {
            return RTC::PRECONDITION_NOT_MET;
        }
    }
    if (!is_of_this || profile.ports.length() < 2) return RTC::BAD_PARAMETER;
    const std::lock_guard lock(mutex_);
    if (connections_.size() >= most_connections) return RTC::OUT_OF_RESOURCES;
    if (!connections_.try_emplace(profile.connector_id.in(), Connection{profile, terms, nullptr}).second)
        return RTC::PRECONDITION_NOT_MET;
    return RTC::RTC_OK;
}

RtcInlet PortObject::inlet_of(const RTC::ConnectorProfile& profile) const {
    const std::string name = profile.name.in();
    return {home_.site, port_.path, name.empty() ? std::string(profile.connector_id.in()) : name, of_velocities()};
}

RtcOutlet PortObject::outlet_of(const RTC::ConnectorProfile& profile) const {
    RtcOutlet outlet{.peer = RTC::PortService::_nil(), .of_velocities = of_velocities()};
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        if (!is_self(profile.ports[i])) outlet.peer = RTC::PortService::_duplicate(profile.ports[i]);
    }
    return outlet;
}

RTC::ReturnCode_t PortObject::notify_connect(RTC::ConnectorProfile& connector) {
    if (connector.connector_id.in()[0] == '\0' || !is_short(connector)) return RTC::BAD_PARAMETER;
    const std::string id = connector.connector_id.in();  // a peer may answer with another one
    const std::string type = text_of(connector.properties, "dataport.data_type");
    if (!type.empty() && type != port_.type && type != port_.type_id()) return RTC::BAD_PARAMETER;
    const auto terms = terms_of(connector.properties);
    if (!terms) return RTC::BAD_PARAMETER;
    if (const auto other = port_of_ours(connector); other.in() != nullptr)
        return connect_inside(connector, *other.in());
    if (const auto reserved = reserve(connector, *terms); reserved != RTC::RTC_OK) return reserved;
    const RTC::ReturnCode_t made = ask([&] { return make(connector, *terms); });
    if (made != RTC::RTC_OK) end(take_away(id));
    return made;
}

// From here on, every error undoes the previous steps.
RTC::ReturnCode_t PortObject::make(RTC::ConnectorProfile& profile, const Terms& terms) {
    // If the peer calls us, the profile must have our reference.
    std::unique_ptr<Connector> connector;
    const bool is_called = port_.is_in == terms.push;
    if (is_called) {
        connector = port_.is_in ? make_push_inlet(home_.orb, inlet_of(profile), terms)
                                : make_pull_outlet(home_.orb, outlet_of(profile));
        set_text(profile.properties, port_.is_in ? in_port_reference : out_port_reference, connector->reference());
    }
    if (port_.is_in) ask_for_empty_answers(profile.properties);
    if (const auto told = notify_next(profile); told != RTC::RTC_OK) return told;
    if (!is_short(profile)) return RTC::BAD_PARAMETER;
    if (!is_called) {
        const std::string reference = text_of(profile.properties, port_.is_in ? out_port_reference : in_port_reference);
        connector = port_.is_in ? make_pull_inlet(home_.orb, reference, inlet_of(profile), terms)
                                : make_push_outlet(home_.orb, reference, outlet_of(profile), terms);
        if (connector == nullptr) return RTC::BAD_PARAMETER;
    }
    const std::lock_guard lock(mutex_);
    const auto found = connections_.find(profile.connector_id.in());
    if (found == connections_.end()) return RTC::RTC_ERROR;  // the connection was removed meanwhile
    found->second.profile = profile;
    found->second.connector = std::move(connector);
    return RTC::RTC_OK;
}

RTC::ReturnCode_t PortObject::notify_next(RTC::ConnectorProfile& profile) {
    for (CORBA::ULong i = 0; i + 1 < profile.ports.length(); ++i) {
        if (!is_self(profile.ports[i])) continue;
        const RTC::PortService_var next = RTC::PortService::_duplicate(profile.ports[i + 1]);
        return next->notify_connect(profile);
    }
    return RTC::RTC_OK;
}

RTC::ReturnCode_t PortObject::notify_disconnect(const char* id) {
    const std::string own_copy = id;
    if (const auto inside = disconnect_inside(own_copy)) return *inside;
    settle(own_copy, std::chrono::steady_clock::now() + longest_settling);
    return leave(own_copy);
}

RTC::ReturnCode_t PortObject::leave(const std::string& id) {
    Connection connection = take_away(id);
    if (connection.profile.ports.length() == 0) return RTC::BAD_PARAMETER;
    const RTC::PortServiceList ports = connection.profile.ports;
    end(std::move(connection));
    for (CORBA::ULong i = 0; i + 1 < ports.length(); ++i) {
        if (is_self(ports[i])) return ask([&] { return ports[i + 1]->notify_disconnect(id.c_str()); });
    }
    return RTC::RTC_OK;
}

}  // namespace nezumi::openrtm

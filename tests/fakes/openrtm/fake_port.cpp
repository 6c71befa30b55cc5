// A data port as OpenRTM-aist's programs have it. Written separately from nezumi's own ports, so that both can't have
// the same mistake.
#include "tests/fakes/openrtm/fake_port.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

namespace nezumi::fakes {

std::string to_hex(const Bytes& bytes) {
    std::string text;
    for (const unsigned char byte : bytes) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

Bytes from_hex(const std::string& text) {
    Bytes bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2)
        bytes.push_back(static_cast<unsigned char>(std::stoi(text.substr(i, 2), nullptr, 16)));
    return bytes;
}

void print(const std::string& line) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
}

std::string property(const SDOPackage::NVList& list, const std::string& name) {
    for (CORBA::ULong i = 0; i < list.length(); ++i) {
        const char* text = nullptr;
        if (name == list[i].name.in() && (list[i].value >>= text)) return text;
    }
    return "";
}

void add_property(SDOPackage::NVList& list, const std::string& name, const std::string& text) {
    list.length(list.length() + 1);
    list[list.length() - 1].name = name.c_str();
    list[list.length() - 1].value <<= text.c_str();
}

OpenRTM::PortStatus FakeCdr::put(const OpenRTM::CdrData& data) {
    const Bytes message(data.get_buffer(), data.get_buffer() + data.length());
    print("got " + to_hex(message));
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds_.load()));
    const std::lock_guard lock(mutex_);
    unread_.push_back(message);
    return OpenRTM::PORT_OK;
}

bool FakeCdr::read(Bytes& message) {
    const std::lock_guard lock(mutex_);
    if (unread_.empty()) return false;
    message = unread_.back();
    unread_.clear();
    return true;
}

void FakeCdr::forget() {
    const std::lock_guard lock(mutex_);
    unread_.clear();
}

OpenRTM::PortStatus FakeBuffer::get(OpenRTM::CdrData_out data) {
    OpenRTM::CdrData_var answer = new OpenRTM::CdrData;
    const std::lock_guard lock(mutex_);
    const bool is_there = !waiting_.empty() || (reads_back_ && !last_.empty());
    if (!waiting_.empty()) {
        last_ = waiting_.front();
        waiting_.pop_front();
    }
    if (is_there) {
        answer->length(static_cast<CORBA::ULong>(last_.size()));
        for (CORBA::ULong i = 0; i < answer->length(); ++i) answer[i] = last_[i];
    }
    data = answer._retn();
    return is_there ? OpenRTM::PORT_OK : OpenRTM::BUFFER_EMPTY;
}

void FakeBuffer::put(const Bytes& bytes) {
    constexpr std::size_t most_waiting = 8;
    const std::lock_guard lock(mutex_);
    if (waiting_.size() == most_waiting) waiting_.pop_front();
    waiting_.push_back(bytes);
}

FakePort::FakePort(CORBA::ORB_ptr orb, std::string name, std::string type, bool is_in)
    : orb_(CORBA::ORB::_duplicate(orb)), name_(std::move(name)), type_(std::move(type)), is_in_(is_in) {}

void FakePort::send(const Bytes& bytes) {
    std::vector<OpenRTM::InPortCdr_var> peers;
    bool pull = false;
    {
        const std::lock_guard lock(mutex_);
        for (auto& [id, connection] : connections_) {
            pull = pull || connection.pull;
            if (!connection.pull) peers.push_back(connection.peer_in);
        }
    }
    if (pull) buffer_->put(bytes);
    for (auto& peer : peers) {
        OpenRTM::CdrData data;
        data.length(static_cast<CORBA::ULong>(bytes.size()));
        for (CORBA::ULong i = 0; i < data.length(); ++i) data[i] = bytes[i];
        try {
            print("sent " + std::to_string(static_cast<int>(peer->put(data))));
        } catch (const CORBA::Exception& error) {
            print(std::string("sent ") + error._name());
        }
    }
    if (peers.empty()) print(pull ? "kept" : "sent to nobody");
}

std::vector<double> FakePort::time_sends(int count, const Bytes& bytes) {
    OpenRTM::InPortCdr_var peer;
    {
        const std::lock_guard lock(mutex_);
        for (auto& [id, connection] : connections_) {
            if (!connection.pull) peer = connection.peer_in;
        }
    }
    OpenRTM::CdrData data;
    data.length(static_cast<CORBA::ULong>(bytes.size()));
    for (CORBA::ULong i = 0; i < data.length(); ++i) data[i] = bytes[i];
    std::vector<double> times;
    for (int i = 0; i < count; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        static_cast<void>(peer->put(data));
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    return times;
}

std::vector<FakePort::Connection> FakePort::connections() {
    const std::lock_guard lock(mutex_);
    std::vector<Connection> all;
    for (auto& [id, connection] : connections_) all.push_back(connection);
    return all;
}

void FakePort::execute(double rate, const Bytes& message, bool stamps) {
    rate_ = rate;
    const int own = ++executions_;
    std::thread([=, this, message = message]() mutable {
        const auto period =
            std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(1 / rate));
        for (auto next = std::chrono::steady_clock::now(); executions_ == own; next += period) {
            std::this_thread::sleep_until(next);
            if (stamps && ++message[0] == 0) ++message[1];
            try {
                is_in_ ? read_once() : write_once(message);
            } catch (const CORBA::Exception&) {
                // Whoever is connected has gone: it is told so.
            }
        }
    }).detach();
}

void FakePort::read_once() {
    Bytes message;
    if (cdr_->read(message)) print("reads " + to_hex(message));
    for (Connection& each : connections()) {
        if (!each.pull) continue;
        const std::lock_guard lock(reading_);
        OpenRTM::CdrData_var data;
        if (each.peer_out->get(data.out()) == OpenRTM::PORT_OK)
            print("reads " + to_hex({data->get_buffer(), data->get_buffer() + data->length()}));
    }
}

void FakePort::write_once(const Bytes& message) {
    Bytes copy = message;
    const auto size = static_cast<CORBA::ULong>(copy.size());
    for (Connection& each : connections()) {
        if (each.pull) {
            buffer_->put(message);
        } else {
            static_cast<void>(each.peer_in->put(OpenRTM::CdrData(size, size, copy.data(), false)));
        }
    }
}

void FakePort::fetch() {
    std::vector<OpenRTM::OutPortCdr_var> peers;
    {
        const std::lock_guard lock(mutex_);
        for (auto& [id, connection] : connections_) {
            if (connection.pull) peers.push_back(connection.peer_out);
        }
    }
    for (auto& peer : peers) {
        OpenRTM::CdrData_var data;
        const auto status = peer->get(data.out());
        const bool is_there = status == OpenRTM::PORT_OK;
        print(is_there ? "got " + to_hex({data->get_buffer(), data->get_buffer() + data->length()}) : "empty");
    }
}

int FakePort::connect_to(RTC::PortService_ptr other, RTC::ConnectorProfile profile, bool is_last) {
    profile.ports.length(2);
    profile.ports[is_last ? 1 : 0] = _this();
    profile.ports[is_last ? 0 : 1] = RTC::PortService::_duplicate(other);
    return static_cast<int>(connect(profile));
}

namespace {

// A connection of these is looked through for long.
RTC::ConnectorProfile long_profile(RTC::PortService_ptr begin, RTC::PortService_ptr end) {
    constexpr CORBA::ULong often = 300;
    RTC::ConnectorProfile profile;
    profile.name = "one of many";
    profile.ports.length(often + 1);
    for (CORBA::ULong i = 0; i < often; ++i) profile.ports[i] = RTC::PortService::_duplicate(begin);
    profile.ports[often] = RTC::PortService::_duplicate(end);
    return profile;
}

}  // namespace

int FakePort::connect_at_once(RTC::PortService_ptr other) {
    const RTC::PortService_var self = _this();
    std::atomic<int> agreed = 0;
    const auto connect = [&](RTC::PortService_ptr port, const std::string& id) {
        RTC::ConnectorProfile profile = long_profile(port, other);
        profile.connector_id = id.c_str();
        if (other->notify_connect(profile) == RTC::RTC_OK) ++agreed;
    };
    std::vector<std::string> ids;
    for (int i = 0; i < 8; ++i) {
        const RTC::PortService_var third = (new FakePort(orb_, "third", type_, is_in_))->_this();
        ids.push_back("third " + std::to_string(i));
        connect(third, ids.back());
    }
    agreed = 0;
    std::thread first([&] { connect(self, "first"); });
    connect(self, "second");
    first.join();
    ids.insert(ids.end(), {"first", "second"});
    for (const std::string& id : ids) other->notify_disconnect(id.c_str());
    return agreed;
}

int FakePort::disconnect_first() {
    std::string id;
    {
        const std::lock_guard lock(mutex_);
        if (!connections_.empty()) id = connections_.begin()->first;
    }
    return static_cast<int>(disconnect(id.c_str()));
}

RTC::PortProfile* FakePort::get_port_profile() {
    RTC::PortProfile_var profile = new RTC::PortProfile;
    profile->name = name_.c_str();
    profile->port_ref = _this();
    profile->owner = RTC::RTObject::_duplicate(owner_);
    add_property(profile->properties, "port.port_type", is_in_ ? "DataInPort" : "DataOutPort");
    add_property(profile->properties, "dataport.data_type", "IDL:RTC/" + type_ + ":1.0");
    const RTC::ConnectorProfileList_var connectors = get_connector_profiles();
    profile->connector_profiles = connectors.in();
    return profile._retn();
}

RTC::ConnectorProfileList* FakePort::get_connector_profiles() {
    RTC::ConnectorProfileList_var list = new RTC::ConnectorProfileList;
    const std::lock_guard lock(mutex_);
    for (const auto& [id, connection] : connections_) {
        list->length(list->length() + 1);
        list[list->length() - 1] = connection.profile;
    }
    return list._retn();
}

RTC::ConnectorProfile* FakePort::get_connector_profile(const char* id) {
    const std::lock_guard lock(mutex_);
    const auto found = connections_.find(id);
    return found != connections_.end() ? new RTC::ConnectorProfile(found->second.profile) : new RTC::ConnectorProfile;
}

RTC::ReturnCode_t FakePort::connect(RTC::ConnectorProfile& profile) {
    if (profile.connector_id.in()[0] == '\0') {
        const std::string id = name_ + "-" + std::to_string(getpid()) + "-" + std::to_string(++made_);
        profile.connector_id = id.c_str();
    }
    try {
        const RTC::PortService_var first = RTC::PortService::_duplicate(profile.ports[0]);
        return first->notify_connect(profile);
    } catch (const CORBA::Exception&) {
        return RTC::RTC_ERROR;
    }
}

RTC::ReturnCode_t FakePort::disconnect(const char* id) {
    RTC::PortServiceList ports;
    {
        const std::lock_guard lock(mutex_);
        const auto found = connections_.find(id);
        if (found == connections_.end()) return RTC::BAD_PARAMETER;
        ports = found->second.profile.ports;
    }
    const std::string own_copy = id;
    return ports[0]->notify_disconnect(own_copy.c_str());
}

RTC::PortService_ptr FakePort::next_of(const RTC::ConnectorProfile& profile) {
    const RTC::PortService_var self = _this();
    for (CORBA::ULong i = 0; i + 1 < profile.ports.length(); ++i) {
        if (self->_is_equivalent(profile.ports[i])) return RTC::PortService::_duplicate(profile.ports[i + 1]);
    }
    return RTC::PortService::_nil();
}

RTC::ReturnCode_t FakePort::notify_connect(RTC::ConnectorProfile& profile) {
    Connection connection;
    connection.pull = property(profile.properties, "dataport.dataflow_type") == "pull";
    if (is_in_ && !connection.pull) {
        const OpenRTM::InPortCdr_var object = cdr_->_this();
        const CORBA::String_var text = orb_->object_to_string(object);
        add_property(profile.properties, "dataport.corba_cdr.inport_ior", text.in());
    }
    if (!is_in_ && connection.pull) {
        buffer_->read_back(reads_back_ &&
                           property(profile.properties, "dataport.outport.buffer.read.empty_policy") != "do_nothing");
        const OpenRTM::OutPortCdr_var object = buffer_->_this();
        const CORBA::String_var text = orb_->object_to_string(object);
        add_property(profile.properties, "dataport.corba_cdr.outport_ior", text.in());
    }
    if (boast_ > 0) add_property(profile.properties, "boast", std::string(boast_, 'x'));
    const RTC::PortService_var next = next_of(profile);
    if (!CORBA::is_nil(next)) {
        const RTC::ReturnCode_t told = next->notify_connect(profile);
        if (told != RTC::RTC_OK) return told;
    }
    if (!is_in_ && !connection.pull) {
        const CORBA::Object_var object =
            orb_->string_to_object(property(profile.properties, "dataport.corba_cdr.inport_ior").c_str());
        connection.peer_in = OpenRTM::InPortCdr::_narrow(object);
    }
    if (is_in_ && connection.pull) {
        const CORBA::Object_var object =
            orb_->string_to_object(property(profile.properties, "dataport.corba_cdr.outport_ior").c_str());
        connection.peer_out = OpenRTM::OutPortCdr::_narrow(object);
    }
    connection.profile = profile;
    {
        const std::lock_guard lock(mutex_);
        connections_[profile.connector_id.in()] = connection;
    }
    print("joined " + std::string(profile.name.in()));
    return RTC::RTC_OK;
}

// As in OpenRTM-aist the next port is told first: what this one has not read till then it may still read.
RTC::ReturnCode_t FakePort::notify_disconnect(const char* id) {
    RTC::ConnectorProfile profile;
    {
        const std::lock_guard lock(mutex_);
        const auto found = connections_.find(id);
        if (found == connections_.end()) return RTC::BAD_PARAMETER;
        profile = found->second.profile;
    }
    const RTC::PortService_var next = next_of(profile);
    RTC::ReturnCode_t told = RTC::RTC_OK;
    try {
        if (!CORBA::is_nil(next)) told = next->notify_disconnect(profile.connector_id.in());
    } catch (const CORBA::Exception&) {
        told = RTC::RTC_ERROR;
    }
    {
        const std::lock_guard lock(mutex_);
        connections_.erase(profile.connector_id.in());
    }
    cdr_->forget();
    const std::lock_guard reading(reading_);  // what was fetched before is told before
    print("left " + std::string(profile.name.in()));
    return told;
}

}  // namespace nezumi::fakes

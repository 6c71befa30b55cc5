// A data port as OpenRTM-aist's programs have it, in or out, push or pull.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <data_port.hh>
#include <rtm.hh>

namespace nezumi::fakes {

using Bytes = std::vector<unsigned char>;

/// "0a1f", and back.
std::string to_hex(const Bytes& bytes);
Bytes from_hex(const std::string& text);

/// Prints a line at once: what the test reads.
void print(const std::string& line);

/// The text of a property; "" for none.
std::string property(const SDOPackage::NVList& list, const std::string& name);
void add_property(SDOPackage::NVList& list, const std::string& name, const std::string& text);

/// Where an in-port's messages come to, and an out-port's are fetched from.
class FakeCdr final : public POA_OpenRTM::InPortCdr {
public:
    OpenRTM::PortStatus put(const OpenRTM::CdrData& data) override;
    /// From now on `put` lasts so long.
    void hang(double seconds) { seconds_ = seconds; }

private:
    std::atomic<double> seconds_ = 0;
};

class FakeBuffer final : public POA_OpenRTM::OutPortCdr {
public:
    OpenRTM::PortStatus get(OpenRTM::CdrData_out data) override;
    void put(const Bytes& bytes);

private:
    std::mutex mutex_;
    std::deque<Bytes> waiting_;
};

class FakePort final : public POA_RTC::PortService {
public:
    FakePort(CORBA::ORB_ptr orb, std::string name, std::string type, bool is_in);

    /// Sends to every connection: by its peer's `put`, or for its `get`. Prints "sent STATUS" of each that is pushed.
    void send(const Bytes& bytes);
    /// Sends so often to the first peer that is pushed to, and says how long [s] each took.
    std::vector<double> time_sends(int count, const Bytes& bytes);
    /// Asks the peer of every pull connection; prints "got HEX" or "empty".
    void fetch();
    void hang(double seconds) { cdr_->hang(seconds); }
    /// From now on whoever connects is told a property so long.
    void boast(std::size_t letters) { boast_ = letters; }
    /// Connects to another port, with what `profile` says but for the ports; the answer's number.
    int connect_to(RTC::PortService_ptr other, RTC::ConnectorProfile profile);
    /// Tells another port alone, twice at once, that it is connected to this one, and takes that back; how
    /// often it agreed.
    int connect_at_once(RTC::PortService_ptr other);
    int disconnect_first();

    RTC::PortProfile* get_port_profile() override;
    RTC::ConnectorProfileList* get_connector_profiles() override;
    RTC::ConnectorProfile* get_connector_profile(const char* id) override;
    RTC::ReturnCode_t connect(RTC::ConnectorProfile& profile) override;
    RTC::ReturnCode_t disconnect(const char* id) override;
    RTC::ReturnCode_t disconnect_all() override { return RTC::RTC_OK; }
    RTC::ReturnCode_t notify_connect(RTC::ConnectorProfile& profile) override;
    RTC::ReturnCode_t notify_disconnect(const char* id) override;

private:
    struct Connection {
        RTC::ConnectorProfile profile;
        OpenRTM::InPortCdr_var peer_in;
        OpenRTM::OutPortCdr_var peer_out;
        bool pull = false;
    };
    RTC::PortService_ptr next_of(const RTC::ConnectorProfile& profile);

    CORBA::ORB_var orb_;
    const std::string name_, type_;
    const bool is_in_;
    PortableServer::Servant_var<FakeCdr> cdr_{new FakeCdr};
    PortableServer::Servant_var<FakeBuffer> buffer_{new FakeBuffer};
    std::atomic<std::size_t> boast_ = 0;
    std::mutex mutex_;
    std::map<std::string, Connection> connections_;
    int made_ = 0;
};

}  // namespace nezumi::fakes

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
    /// What waits for the RTC to execute: the latest message. Returns whether there is one.
    bool read(Bytes& message);
    /// The buffer goes with its connection.
    void forget();

private:
    std::atomic<double> seconds_ = 0;
    std::mutex mutex_;
    std::deque<Bytes> unread_;
};

class FakeBuffer final : public POA_OpenRTM::OutPortCdr {
public:
    OpenRTM::PortStatus get(OpenRTM::CdrData_out data) override;
    /// As in OpenRTM-aist 8 wait, then the oldest is overwritten.
    void put(const Bytes& bytes);
    /// What `get` gives of an empty buffer: the last message again, or nothing.
    void read_back(bool reads_back) { reads_back_ = reads_back; }

private:
    std::atomic<bool> reads_back_ = false;
    std::mutex mutex_;
    std::deque<Bytes> waiting_;
    Bytes last_;
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
    /// Its buffers read back, unless the connection asks for `do_nothing` before they are made.
    void read_back() { reads_back_ = true; }
    /// Executes so often: an in-port reads, and prints "reads HEX" of what is new; an out-port writes the message,
    /// where `stamps` with another stamp each time.
    void execute(double rate, const Bytes& message, bool stamps);
    void stall() { executions_ = executions_ + 1; }
    double rate() const { return rate_; }
    /// The RTC that has it: told before anybody knows the port.
    void set_owner(RTC::RTObject_ptr owner) { owner_ = RTC::RTObject::_duplicate(owner); }
    /// From now on whoever connects is told a property so long.
    void boast(std::size_t letters) { boast_ = letters; }
    /// Connects to another port, with what `profile` says but for the ports; the answer's number. This port is the
    /// first to be told, or the last.
    int connect_to(RTC::PortService_ptr other, RTC::ConnectorProfile profile, bool is_last = false);
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
    std::vector<Connection> connections();
    void read_once();
    void write_once(const Bytes& message);

    CORBA::ORB_var orb_;
    const std::string name_, type_;
    const bool is_in_;
    PortableServer::Servant_var<FakeCdr> cdr_{new FakeCdr};
    PortableServer::Servant_var<FakeBuffer> buffer_{new FakeBuffer};
    RTC::RTObject_var owner_;
    std::atomic<std::size_t> boast_ = 0;
    std::atomic<bool> reads_back_ = false;
    std::atomic<int> executions_ = 0;  // that were begun; each ends with the next
    std::atomic<double> rate_ = 1000;
    std::mutex reading_;  // a message is fetched and told
    std::mutex mutex_;
    std::map<std::string, Connection> connections_;
    int made_ = 0;
};

}  // namespace nezumi::fakes

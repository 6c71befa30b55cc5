// A data port of an RTC: its profile, and its connections.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtm.hh>
#include "bindings/openrtm/orb/connector.hpp"
#include "bindings/openrtm/orb/velocity_bytes.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

/// Where ports and RTCs live.
struct Home {
    CORBA::ORB_ptr orb;
    RtcSite& site;
};

class PortObject final : public POA_RTC::PortService {
public:
    /// Connections at once.
    static constexpr std::size_t most_connections = 32;
    /// Of a connection's name, and of its id.
    static constexpr std::size_t most_letters = 256;
    /// How long the end of a connection waits for a robot to hear that it is to stop.
    static constexpr std::chrono::seconds longest_settling{1};
    /// Of all that a connection is told with: its ports and properties, as CORBA sends them.
    static constexpr std::size_t most_bytes = std::size_t{64} << 10;

    PortObject(const Home& home, RtcPort port);

    const RtcPort& port() const { return port_; }
    /// Begins, as a port of this RTC, which is called so. Nobody knows the port before.
    RTC::PortService_ptr begin(RTC::RTObject_ptr owner, const std::string& instance);
    /// Nobody reaches it any more. Its connections are ended first, which waits until `deadline` at most for robots to
    /// hear that they are to stop.
    void withdraw(std::chrono::steady_clock::time_point deadline);
    /// Its connections are about to end: robots are told to stop.
    void stop();

    // From the thread that ticks: waits for nobody.
    WantedOrders wanted();
    void publish(std::span<const std::uint8_t> bytes, std::endian order);

    // Each takes away the connections whose peer is gone, and returns their names.
    std::vector<std::string> drop_lost();
    /// Asks the ports at the other ends whether they are there, one after the other while `goes_on`.
    std::vector<std::string> ask_peers(const std::function<bool()>& goes_on);
    /// The name of the connection with another port; "" when there is none.
    std::string connection_with(RTC::PortService_ptr other);

    RTC::PortProfile* get_port_profile() override;
    RTC::ConnectorProfileList* get_connector_profiles() override;
    RTC::ConnectorProfile* get_connector_profile(const char* id) override;
    RTC::ReturnCode_t connect(RTC::ConnectorProfile& connector) override;
    RTC::ReturnCode_t disconnect(const char* id) override;
    RTC::ReturnCode_t disconnect_all() override;
    RTC::ReturnCode_t notify_connect(RTC::ConnectorProfile& connector) override;
    RTC::ReturnCode_t notify_disconnect(const char* id) override;

private:
    // A connection; being made as long as it has no connector.
    struct Connection {
        RTC::ConnectorProfile profile{};
        Terms terms{};
        std::unique_ptr<Connector> connector{};
    };
    using Connections = std::map<std::string, Connection>;

    RTC::ReturnCode_t reserve(const RTC::ConnectorProfile& profile, const Terms& terms);
    RTC::ReturnCode_t make(RTC::ConnectorProfile& profile, const Terms& terms);
    RTC::ReturnCode_t notify_next(RTC::ConnectorProfile& profile);
    bool of_velocities() const { return port_.type == velocity_type; }
    RtcInlet inlet_of(const RTC::ConnectorProfile& profile) const;
    RtcOutlet outlet_of(const RTC::ConnectorProfile& profile) const;
    void settle(const std::string& id, std::chrono::steady_clock::time_point deadline);
    RTC::ReturnCode_t disconnect(const std::string& id, std::chrono::steady_clock::time_point deadline);
    RTC::ReturnCode_t leave(const std::string& id);
    Connection take_away(const std::string& id);
    void end(Connection connection);
    std::vector<std::string> ids();
    bool is_self(RTC::PortService_ptr other) const;

    const Home home_;
    const RtcPort port_;
    SDOPackage::NVList properties_;
    RTC::PortService_var self_;  // from here to the name as `begin` has set them
    RTC::RTObject_var owner_;
    std::string name_;

    Mutex reserving_;  // held from the look for a connection until the new one has its place; ticks never wait for it
    Mutex mutex_;      // of the connections; never held while a peer is called
    Connections connections_;
};

}  // namespace nezumi::openrtm

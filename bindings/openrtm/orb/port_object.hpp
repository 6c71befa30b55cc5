// A data port of an RTC: its profile and its connections.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <rtm.hh>
#include "bindings/openrtm/orb/connector.hpp"
#include "bindings/openrtm/orb/velocity_bytes.hpp"
#include "engine/base/mutex.hpp"

namespace nezumi::openrtm {

/// The environment of ports and RTCs.
struct Home {
    CORBA::ORB_ptr orb;
    RtcSite& site;
};

/// The id of a new connection: 128 random bits in the form of a UUID.
std::string new_id();

class PortObject final : public POA_RTC::PortService {
public:
    /// The largest number of connections at the same time.
    static constexpr std::size_t most_connections = 32;
    /// The longest name and id of a connection.
    static constexpr std::size_t most_letters = 256;
    /// The longest time that the end of a connection waits for a robot to receive its stop.
    static constexpr std::chrono::seconds longest_settling{1};
    /// The largest size of a connection's ports and properties in CORBA's encoding.
    static constexpr std::size_t most_bytes = std::size_t{64} << 10;

    PortObject(const Home& home, RtcPort port);

    const RtcPort& port() const { return port_; }
    /// Activates the port for this RTC, with its instance name. Before that it is unknown to others.
    RTC::PortService_ptr begin(RTC::RTObject_ptr owner, const std::string& instance);
    /// Deactivates the port. Ends its connections first, and waits until `deadline` at most for robots to receive their
    /// stop.
    void withdraw(std::chrono::steady_clock::time_point deadline);
    /// Sends velocity 0 to robots, because the connections will end.
    void stop();

    // These are called by the ticking thread, and do not wait.
    WantedOrders wanted();
    void publish(std::span<const std::uint8_t> bytes, std::endian order);

    // Each of these removes the connections whose peer is gone, and returns their names.
    std::vector<std::string> drop_lost();
    /// Asks the ports at the other ends whether they are alive, one after the other while `goes_on`.
    std::vector<std::string> ask_peers(const std::function<bool()>& goes_on);
    /// The name of the connection with another port; "" if there is none.
    std::string connection_with(RTC::PortService_ptr other);
    /// A connection with a port of another program.
    struct Made {
        std::string id;
        RTC::PortService_var other;
    };
    std::vector<Made> made();

    // Connections with ports of ours, which the system carries:
    /// Removes all except those with ports of these paths and those that a tool has just made.
    void keep_inside(const std::vector<std::string>& others);
    /// Shows a connection at both of its ports, unless they show it already.
    static void show_inside(PortObject& from, PortObject& to);

    RTC::PortProfile* get_port_profile() override;
    RTC::ConnectorProfileList* get_connector_profiles() override;
    RTC::ConnectorProfile* get_connector_profile(const char* id) override;
    RTC::ReturnCode_t connect(RTC::ConnectorProfile& connector) override;
    RTC::ReturnCode_t disconnect(const char* id) override;
    RTC::ReturnCode_t disconnect_all() override;
    RTC::ReturnCode_t notify_connect(RTC::ConnectorProfile& connector) override;
    RTC::ReturnCode_t notify_disconnect(const char* id) override;

private:
    // A connection. While it is being made, it has no connector.
    struct Connection {
        RTC::ConnectorProfile profile{};
        Terms terms{};
        std::unique_ptr<Connector> connector{};
    };
    using Connections = std::map<std::string, Connection>;
    // A connection with a port of ours.
    struct Inside {
        RTC::ConnectorProfile profile{};
        std::chrono::steady_clock::time_point made{};
    };

    RTC::ReturnCode_t reserve(const RTC::ConnectorProfile& profile, const Terms& terms);
    RTC::ReturnCode_t make(RTC::ConnectorProfile& profile, const Terms& terms);
    RTC::ReturnCode_t notify_next(RTC::ConnectorProfile& profile);
    bool of_velocities() const { return port_.type == velocity_type; }
    RtcInlet inlet_of(const RTC::ConnectorProfile& profile) const;
    RtcOutlet outlet_of(const RTC::ConnectorProfile& profile) const;
    void settle(const std::string& id, std::chrono::steady_clock::time_point deadline);
    RTC::ReturnCode_t disconnect(const std::string& id, std::chrono::steady_clock::time_point deadline);
    RTC::ReturnCode_t leave(const std::string& id);
    PortableServer::Servant_var<PortObject> port_of_ours(const RTC::ConnectorProfile& profile);
    void add_inside(const std::string& other, const RTC::ConnectorProfile& profile);
    RTC::ReturnCode_t request_inside(RtcRequest::What what, const std::string& other);
    RTC::ReturnCode_t connect_inside(const RTC::ConnectorProfile& profile, PortObject& other);
    std::optional<RTC::ReturnCode_t> disconnect_inside(const std::string& id);
    Connection take_away(const std::string& id);
    void end(Connection connection);
    std::vector<std::string> ids();
    bool is_self(RTC::PortService_ptr other) const;

    const Home home_;
    const RtcPort port_;
    SDOPackage::NVList properties_;
    RTC::PortService_var self_;  // the members up to the name are set by `begin`
    RTC::RTObject_var owner_;
    std::string name_;

    Mutex reserving_;  // held from the search for a connection until the new one is stored; ticks never wait for it
    Mutex mutex_;      // for the connections; never held while a peer is called
    Connections connections_;
    std::map<std::string, Inside> inside_;  // by the path of the other port
};

}  // namespace nezumi::openrtm

// One connection of a data port; it has its own thread if it calls the peer.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/terms.hpp"

namespace nezumi::openrtm {

/// Names of a connection's properties: the CORBA reference of the in-port's side, and of the out-port's side.
inline constexpr const char* in_port_reference = "dataport.corba_cdr.inport_ior";
inline constexpr const char* out_port_reference = "dataport.corba_cdr.outport_ior";

class Connector {
public:
    virtual ~Connector() = default;
    /// Sends a message of the out-port, encoded in the byte order of the connection's terms.
    virtual void publish(std::span<const std::uint8_t> /*bytes*/) {}
    /// The connection will end: later messages are dropped, and zero is sent to a robot that may be moving. Does not
    /// wait.
    virtual void stop() {}
    /// True if the peer has received the zero that `stop` sends, and had time to use it.
    virtual bool is_settled() { return true; }
    /// True if the peer is gone and no more data are exchanged.
    virtual bool is_lost() const { return false; }
    /// The CORBA reference that the peer calls; "" if we call the peer.
    virtual std::string reference() const { return ""; }
};

/// Where the messages of an in-port's connection go, and the name of the connection.
struct RtcInlet {
    RtcSite& site;
    std::string path{};
    std::string from{};
    bool of_velocities = false;
};

/// Where the messages of an out-port's connection go.
struct RtcOutlet {
    RTC::PortService_var peer{};  ///< the port at the other end
    bool of_velocities = false;
};

/// Makes a connection of an in-port to which the peer pushes: the peer calls us.
std::unique_ptr<Connector> make_push_inlet(CORBA::ORB_ptr orb, const RtcInlet& inlet, const Terms& terms);
std::unique_ptr<Connector> make_pull_outlet(CORBA::ORB_ptr orb, const RtcOutlet& outlet);
/// Makes a connection of an in-port that fetches: we call the peer. Returns nullptr if the reference is invalid.
std::unique_ptr<Connector> make_pull_inlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcInlet& inlet,
                                           const Terms& terms);
std::unique_ptr<Connector> make_push_outlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcOutlet& outlet,
                                            const Terms& terms);

}  // namespace nezumi::openrtm

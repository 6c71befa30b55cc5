// One connection of a data port: how its messages go, in a thread of its own where it calls the peer.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <rtm.hh>
#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/terms.hpp"

namespace nezumi::openrtm {

/// What is told of the in-port's side in a connection's properties, and what of the out-port's.
inline constexpr const char* in_port_reference = "dataport.corba_cdr.inport_ior";
inline constexpr const char* out_port_reference = "dataport.corba_cdr.outport_ior";

class Connector {
public:
    virtual ~Connector() = default;
    /// A message of the out-port, in the order of the terms.
    virtual void publish(std::span<const std::uint8_t> /*bytes*/) {}
    /// The connection is about to end: what is published from now on is dropped, and a robot that may move is sent
    /// zero. Waits for nobody.
    virtual void stop() {}
    /// The peer has what `stop` left for it, and had the time to act on it.
    virtual bool is_settled() { return true; }
    /// The peer is gone: nothing comes or goes any more.
    virtual bool is_lost() const { return false; }
    /// The reference for the peer, where it is the one that calls; "" else.
    virtual std::string reference() const { return ""; }
};

/// Where an in-port's messages go, and under which name they come.
struct RtcInlet {
    RtcSite& site;
    std::string path{};
    std::string from{};
    bool of_velocities = false;
};

/// Where an out-port's messages go.
struct RtcOutlet {
    RTC::PortService_var peer{};  ///< the port at the other end
    bool of_velocities = false;
};

/// The peer calls us.
std::unique_ptr<Connector> make_push_inlet(CORBA::ORB_ptr orb, const RtcInlet& inlet, const Terms& terms);
std::unique_ptr<Connector> make_pull_outlet(CORBA::ORB_ptr orb, const RtcOutlet& outlet);
/// We call the peer. nullptr when the reference is none.
std::unique_ptr<Connector> make_pull_inlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcInlet& inlet,
                                           const Terms& terms);
std::unique_ptr<Connector> make_push_outlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcOutlet& outlet,
                                            const Terms& terms);

}  // namespace nezumi::openrtm

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
};

/// The peer calls us.
std::unique_ptr<Connector> make_push_inlet(CORBA::ORB_ptr orb, const RtcInlet& inlet, const Terms& terms);
std::unique_ptr<Connector> make_pull_outlet(CORBA::ORB_ptr orb, const Terms& terms);
/// We call the peer. nullptr when the reference is none.
std::unique_ptr<Connector> make_pull_inlet(CORBA::ORB_ptr orb, const std::string& reference, const RtcInlet& inlet,
                                           const Terms& terms);
std::unique_ptr<Connector> make_push_outlet(CORBA::ORB_ptr orb, const std::string& reference, const Terms& terms);

}  // namespace nezumi::openrtm

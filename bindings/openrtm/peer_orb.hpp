// CORBA for a program that only asks RTCs: it exports nothing.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bindings/openrtm/orb.hpp"

namespace nezumi::openrtm {

class PeerOrb {
public:
    /// `nameservers`: "HOST:PORT", not empty. An error says in one line what to install.
    static Expected<PeerOrb> open(std::vector<std::string> nameservers);

    /// Waits for the answer, at most some seconds.
    PeerAnswer ask(PeerQuestion question);

private:
    explicit PeerOrb(std::unique_ptr<RtcSite> site) : site_(std::move(site)) {}

    std::unique_ptr<RtcSite> site_;
    std::unique_ptr<Orb> orb_;  // destroyed first
};

}  // namespace nezumi::openrtm

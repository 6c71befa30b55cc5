// The functions for CORBA's threads are empty, because no component is exported.
#include "bindings/openrtm/peer_orb.hpp"

#include <future>
#include <utility>

namespace nezumi::openrtm {
namespace {

class EmptySite final : public RtcSite {
public:
    RtcSnapshot snapshot(std::string_view /*component*/) override { return {}; }
    RtcAnswer perform(const RtcRequest& /*request*/) override { return RtcAnswer::unknown; }
    std::vector<RtcModule> modules() override { return {}; }
    PutAnswer put(std::string_view /*path*/, std::string_view /*from*/, std::span<const std::uint8_t> /*bytes*/,
                  std::endian /*order*/) override {
        return PutAnswer::unknown;
    }
    void left(std::string_view /*path*/, std::string_view /*from*/) override {}
    void joined(const RtcLink& /*link*/) override {}
    void ended(const RtcLink& /*link*/) override {}
    void tell(bool /*is_problem*/, std::string /*text*/) override {}
};

}  // namespace

Expected<PeerOrb> PeerOrb::open(std::vector<std::string> nameservers) {
    PeerOrb peers(std::make_unique<EmptySite>());
    auto orb = open_orb({.nameservers = std::move(nameservers)}, *peers.site_);
    if (!orb) return Unexpected(orb.error());
    peers.orb_ = std::move(*orb);
    return peers;
}

PeerAnswer PeerOrb::ask(PeerQuestion question) {
    std::promise<PeerAnswer> promise;
    auto answer = promise.get_future();
    orb_->ask(std::move(question), [&](const PeerQuestion&, PeerAnswer given) { promise.set_value(std::move(given)); });
    return answer.get();
}

}  // namespace nezumi::openrtm

// Starts omniORB with its options, and at the end waits for running calls.
#include <omniORB4/CORBA.h>
#include <omniORB4/internal/objectAdapter.h>

#include <charconv>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "bindings/openrtm/orb.hpp"
#include "bindings/openrtm/orb/asker.hpp"
#include "bindings/openrtm/orb/connection_gate.hpp"
#include "bindings/openrtm/orb/keeper.hpp"
#include "engine/base/thread.hpp"

namespace nezumi::openrtm {
namespace {

// The TCP port that the ORB listens on: "giop:tcp:127.0.0.1:41235".
std::uint16_t own_port() {
    const auto& endpoints = omni::omniObjAdapter::listMyEndpoints();
    std::uint16_t port = 0;
    if (endpoints.length() == 0) return port;
    const std::string_view text = endpoints[0].in();
    std::from_chars(text.data() + text.rfind(':') + 1, text.data() + text.size(), port);
    return port;
}

class OmniOrb final : public Orb {
public:
    OmniOrb(CORBA::ORB_ptr orb, RtcSite& site, const OrbOptions& options)
        : orb_(CORBA::ORB::_duplicate(orb)),
          asker_(std::make_unique<Asker>(orb_.in(), options.nameservers)),
          keeper_(std::make_unique<Keeper>(Home{orb_.in(), site}, options)),
          gate_(own_port()) {}
    ~OmniOrb() override {
        keeper_.reset();  // must be the first, because it sends robots their stop
        asker_.reset();
        try {
            orb_->destroy();  // waits for running calls, each at most a second
        } catch (const CORBA::Exception&) {
            return;
        }
    }
    OmniOrb(const OmniOrb&) = delete;
    OmniOrb& operator=(const OmniOrb&) = delete;

    void show(std::vector<RtcProfile> profiles, std::vector<RtcLink> links) override {
        keeper_->show(std::move(profiles), std::move(links));
    }
    void show_inside(std::vector<RtcInside> connections) override { keeper_->show_inside(std::move(connections)); }
    void ask(PeerQuestion question, TakeAnswer take) override { asker_->ask(std::move(question), std::move(take)); }
    WantedOrders wanted(std::string_view path) override { return keeper_->wanted(path); }
    bool is_made(const RtcLink& link) override { return keeper_->is_made(link); }
    void publish(std::string_view path, std::span<const std::uint8_t> bytes, std::endian order) override {
        keeper_->publish(path, bytes, order);
    }

private:
    CORBA::ORB_var orb_;
    std::unique_ptr<Asker> asker_;
    std::unique_ptr<Keeper> keeper_;
    ConnectionGate gate_;
};

CORBA::ORB_ptr begin(const OrbOptions& options) {
    // Limits: the time of a call and of connecting [ms], the size of a message [bytes], the threads for peers.
    const std::string end_point = "giop:tcp:" + options.interface + ":";
    const char* settings[][2] = {{"traceLevel", "0"},  // errors are reported by nezumi
                                 {"clientCallTimeOutPeriod", "1000"},
                                 {"clientConnectTimeOutPeriod", "1000"},
                                 {"giopMaxMsgSize", "16777216"},
                                 {"maxServerThreadPoolSize", "32"},
                                 {"threadPerConnectionUpperLimit", "32"},
                                 {"endPoint", end_point.c_str()},
                                 {nullptr, nullptr}};
    // A configuration file of this computer must not add an end point that others can reach.
    std::string program = "nezumi";
    std::string option = "-ORBconfigFile";
    std::string no_file = "/dev/null";
    char* arguments[] = {program.data(), option.data(), no_file.data(), nullptr};
    int count = 3;
    const CORBA::ORB_var orb = CORBA::ORB_init(count, arguments, "omniORB4", settings);
    const CORBA::Object_var object = orb->resolve_initial_references("RootPOA");
    const PortableServer::POA_var poa = PortableServer::POA::_narrow(object);
    const PortableServer::POAManager_var manager = poa->the_POAManager();
    manager->activate();
    return CORBA::ORB::_duplicate(orb);
}

}  // namespace
}  // namespace nezumi::openrtm

extern "C" __attribute__((visibility("default"))) nezumi::openrtm::Orb* nezumi_open_orb(
    const nezumi::openrtm::OrbOptions& options, nezumi::openrtm::RtcSite& site, std::string& problem) {
    const nezumi::WithoutSignals without_signals;
    try {
        const CORBA::ORB_var orb = nezumi::openrtm::begin(options);
        return std::make_unique<nezumi::openrtm::OmniOrb>(orb.in(), site, options).release();
    } catch (const CORBA::INITIALIZE&) {
        problem = "can't listen at " + options.interface + ": is that an address of this computer?";
    } catch (const CORBA::Exception& error) {
        problem = "CORBA can't start at " + options.interface + ": " + error._name();
    } catch (const std::exception& error) {
        problem = std::string("CORBA can't start: ") + error.what();
    }
    return nullptr;
}

// RT systems that are restored from their profiles: with RTCs that only answer, and with RTCs that are other programs.
#include "bindings/openrtm/restore_system.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "bindings/openrtm/peer_orb.hpp"
#include "tests/unit/openrtm/names.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;
using What = RtcRequest::What;

namespace {

ProfiledComponent component(const std::string& name, bool is_required = true) {
    return {.type = name,
            .instance = name + "0",
            .set = "default",
            .path = "localhost/pc.host_cxt/" + name + "0.rtc",
            .is_required = is_required,
            .sets = {{"default", {{"speed", "0.75"}}}}};
}

SystemProfile two_components() {
    SystemProfile profile{.name = "two", .components = {component("Out"), component("In")}};
    profile.connections.push_back(
        {.from = {"Out0", "out"}, .to = {"In0", "in"}, .properties = {{"dataport.dataflow_type", "push"}}});
    return profile;
}

// RTCs that answer without CORBA, and what was asked of them.
struct Answering {
    std::map<std::string, PeerSnapshot> peers{
        {"pc.host_cxt/Out0", {.state = PeerSnapshot::State::inactive, .ports = {{.name = "out"}}}},
        {"pc.host_cxt/In0", {.state = PeerSnapshot::State::inactive, .ports = {{.name = "in"}}}}};
    std::map<std::string, std::string> refused;  // the problem, by what is asked
    std::vector<std::string> asked, told;
    int waits = 0;

    PeerAnswer answer(const PeerQuestion& question) {
        if (!question.request) {
            const auto found = peers.find(question.name);
            if (found == peers.end()) return {.problem = "there is no RTC '" + question.name + "'"};
            found->second.name = question.name;
            return {.peers = {found->second}};
        }
        const RtcRequest& request = *question.request;
        std::string text = question.name;
        if (request.what == What::connect) text += "connect " + request.from + " " + request.to;
        if (request.what == What::set) text += " set " + request.set + " " + request.values.front().second;
        if (request.what == What::use) text += " use " + request.set;
        if (request.what == What::activate) text += " activate";
        asked.push_back(text);
        return {.problem = refused[text]};
    }
    bool restore(const SystemProfile& profile) {
        return restore_system(profile, {.ask = [this](const PeerQuestion& question) { return answer(question); },
                                        .wait = [this] { return --waits > 0; },
                                        .say = [this](bool, const std::string& line) { told.push_back(line); }});
    }
};

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("a system is restored: connected, configured, and activated at the end", "[openrtm][restore]") {
    Answering rtcs;
    CHECK(rtcs.restore(two_components()));
    CHECK(rtcs.asked == Lines{"connect pc.host_cxt/Out0.out pc.host_cxt/In0.in", "pc.host_cxt/Out0 set default 0.75",
                              "pc.host_cxt/Out0 use default", "pc.host_cxt/In0 set default 0.75",
                              "pc.host_cxt/In0 use default", "pc.host_cxt/Out0 activate", "pc.host_cxt/In0 activate"});
    CHECK(rtcs.told == Lines{"connected: Out0.out to In0.in", "Out0: set default", "In0: set default",
                             "activated: Out0", "activated: In0"});
}

TEST_CASE("a restoration changes nothing while a required component is missing", "[openrtm][restore]") {
    Answering rtcs;
    rtcs.peers.erase("pc.host_cxt/In0");
    rtcs.waits = 3;
    CHECK_FALSE(rtcs.restore(two_components()));
    CHECK(rtcs.asked.empty());
    CHECK(rtcs.told == Lines{"waiting for In0", "In0: there is no RTC 'pc.host_cxt/In0'",
                             "nothing was changed: the system does not work without these components"});
}

TEST_CASE("a restoration changes nothing if a component is in ERROR or has no such port", "[openrtm][restore]") {
    Answering rtcs;
    SECTION("in ERROR") {
        rtcs.peers["pc.host_cxt/Out0"].state = PeerSnapshot::State::error;
        CHECK_FALSE(rtcs.restore(two_components()));
        CHECK(rtcs.told.front() ==
              "Out0: it is in ERROR: reset it, for example by rtm(\"pc.host_cxt/Out0\", \"reset\")");
    }
    SECTION("without the port") {
        rtcs.peers["pc.host_cxt/Out0"].ports = {{.name = "result"}};
        CHECK_FALSE(rtcs.restore(two_components()));
        CHECK(rtcs.told.front() == "Out0: it has no port 'out'");
    }
    CHECK(rtcs.asked.empty());
}

TEST_CASE("a restoration goes on without a component that is not required", "[openrtm][restore]") {
    Answering rtcs;
    rtcs.peers.erase("pc.host_cxt/In0");
    SystemProfile profile = two_components();
    profile.components[1].is_required = false;
    CHECK_FALSE(rtcs.restore(profile));
    CHECK(rtcs.told == Lines{"waiting for In0", "In0: there is no RTC 'pc.host_cxt/In0'",
                             "not connected: Out0.out to In0.in: one of the two components was not found",
                             "Out0: set default", "activated: Out0"});
}

TEST_CASE("a component whose connection or values are refused is not activated", "[openrtm][restore]") {
    Answering rtcs;
    rtcs.refused["pc.host_cxt/In0 set default 0.75"] = "it refuses these values";
    CHECK_FALSE(rtcs.restore(two_components()));
    CHECK(rtcs.told == Lines{"connected: Out0.out to In0.in", "Out0: set default",
                             "In0: set 'default': it refuses these values", "activated: Out0",
                             "not activated: In0: a connection or its configuration was refused, see above"});
    rtcs = {};
    rtcs.refused["connect pc.host_cxt/Out0.out pc.host_cxt/In0.in"] = "it refuses the connection (RTC_ERROR)";
    CHECK_FALSE(rtcs.restore(two_components()));
    CHECK(rtcs.told.back() == "not activated: In0: a connection or its configuration was refused, see above");
    CHECK(rtcs.asked.back() == "pc.host_cxt/In0 use default");
}

TEST_CASE("name services come from the paths of a profile", "[openrtm][restore]") {
    SystemProfile profile = two_components();
    CHECK(nameservers_of(profile) == Lines{"localhost:2809"});
    profile.components[1].path = "/pc:9876/pc.host_cxt/In0.rtc";
    CHECK(nameservers_of(profile) == Lines{"localhost:2809", "pc:9876"});
    profile.components[1].path = "file://x";
    CHECK(nameservers_of(profile).error().message ==
          "component 'In0': path 'file://x': expected \"HOST:PORT\", got 'file:'");
    CHECK(nameservers_of({}) == Lines{"localhost:2809"});
}

TEST_CASE("RTCs of other programs are connected, configured and activated from a profile",
          "[openrtm][restore][wallclock]") {
    Names names;
    const auto start = [&](const std::string& name, const std::string& direction) {
        auto peer = std::make_unique<Peer>(Lines{fake_rtc(), names.address(), name, direction, "TimedLong", direction});
        REQUIRE(peer->heard("ready") == "ready");
        return peer;
    };
    const auto out = start("Out0", "out");
    auto peers = PeerOrb::open({names.address()});
    REQUIRE(peers);
    SystemProfile profile = two_components();
    for (ProfiledComponent& each : profile.components) each.path = "localhost/" + each.instance + ".rtc";
    profile.connections.front().properties = {{"dataport.data_type", "IDL:RTC/TimedLong:1.0"},
                                              {"dataport.interface_type", "corba_cdr"},
                                              {"dataport.dataflow_type", "push"},
                                              {"dataport.subscription_type", "flush"}};
    Lines told;
    std::unique_ptr<Peer> in;
    const auto restore = [&] {
        told.clear();
        return restore_system(profile, {.ask = [&](const PeerQuestion& question) { return peers->ask(question); },
                                        .wait =
                                            [&] {
                                                // It starts late: the restoration waits for it.
                                                if (in == nullptr) in = start("In0", "in");
                                                return true;
                                            },
                                        .say = [&](bool, const std::string& line) { told.push_back(line); }});
    };
    CHECK(restore());
    CHECK(told == Lines{"waiting for In0", "connected: Out0.out to In0.in", "Out0: set default", "In0: set default",
                        "activated: Out0", "activated: In0"});
    CHECK(in->heard("uses ") == "uses default speed=0.75");
    CHECK(in->heard("activated") == "activated");
    out->say("send 000000000000000007000000");
    CHECK(out->heard("sent ") == "sent 0");
    CHECK(in->heard("got ") == "got 000000000000000007000000");
    // All is so already.
    CHECK(restore());
    CHECK(told == Lines{"connected already: Out0.out to In0.in", "Out0: set default", "In0: set default",
                        "active already: Out0", "active already: In0"});
}

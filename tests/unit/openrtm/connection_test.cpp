// A connection as the system's side sees it, with a site in the system's place: what comes, and in which order.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bindings/openrtm/orb.hpp"
#include "tests/unit/openrtm/names.hpp"
#include "tests/unit/openrtm/wire_rig.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;

namespace {

using namespace std::chrono_literals;

// Takes a message as slowly as it is told to, and remembers what was called.
class SlowSite final : public RtcSite {
public:
    RtcSnapshot snapshot(std::string_view /*component*/) override { return {}; }
    RtcAnswer perform(const RtcRequest& /*request*/) override { return RtcAnswer::refused; }
    std::vector<RtcModule> modules() override { return {}; }
    PutAnswer put(std::string_view /*path*/, std::string_view /*from*/, std::span<const std::uint8_t> /*bytes*/,
                  std::endian /*order*/) override {
        takes = true;
        while (!goes_on) std::this_thread::sleep_for(1ms);
        add("put");
        return PutAnswer::taken;
    }
    void left(std::string_view /*path*/, std::string_view /*from*/) override { add("left"); }
    void joined(const RtcLink& /*link*/) override {}
    void ended(const RtcLink& /*link*/) override {}
    void tell(bool /*is_problem*/, std::string text) override { add(text); }

    bool has(const std::string& begin) {
        const std::lock_guard lock(mutex_);
        return std::any_of(calls_.begin(), calls_.end(), [&](const auto& call) { return call.starts_with(begin); });
    }
    std::vector<std::string> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(calls_, {});
    }

    std::atomic<bool> takes = false;
    std::atomic<bool> goes_on = false;

private:
    void add(const std::string& call) {
        const std::lock_guard lock(mutex_);
        calls_.push_back(call);
    }
    std::mutex mutex_;
    std::vector<std::string> calls_;
};

bool soon(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + 20s;
    while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
    return condition();
}

}  // namespace

TEST_CASE("no message of a connection arrives after its end", "[openrtm][connection][wallclock]") {
    const Names names;
    SlowSite site;
    const auto orb = open_orb({.nameservers = {names.address()}}, site);
    REQUIRE(orb);
    const RtcPort in{.path = "mouse.in", .name = "in", .type = "TimedVelocity2D", .is_in = true};
    (*orb)->show({{.component = "mouse", .type = "Mouse", .rate = 100, .ports = {in}}}, {});
    REQUIRE(soon([&] { return site.has("rtm: mouse is "); }));
    Peer out({fake_rtc(), names.address(), "Out0", "out", "TimedVelocity2D", "out"});
    REQUIRE(out.heard("ready") == "ready");
    out.say("connect mouse0 in");
    REQUIRE(out.heard("connected ") == "connected 0");
    out.say("send " + hex_of(Velocity2D{.vx = 0.1}, std::endian::little));
    REQUIRE(soon([&] { return site.takes.load(); }));
    site.take();

    (*orb)->show({}, {});
    REQUIRE_FALSE(out.heard("left ").empty());
    std::this_thread::sleep_for(200ms);  // for an end that does not wait for the message
    CHECK(site.take().empty());
    site.goes_on = true;
    CHECK(soon([&] { return site.has("left"); }));
    CHECK(site.take() == std::vector<std::string>{"put", "left"});
}

// Messages to people about other programs' RTCs.
#include "bindings/openrtm/peer_text.hpp"

#include <catch2/catch.hpp>

using namespace nezumi;
using namespace nezumi::openrtm;

namespace {

std::string told(const PeerQuestion& question, const PeerAnswer& answer) {
    const auto text = told_of_peers(question, answer);
    return text ? *text : "! " + text.error().message;
}

PeerSnapshot out0() {
    return {.name = "pc.host_cxt/Out0",
            .type = "ConsoleOut",
            .state = PeerSnapshot::State::active,
            .ports = {{"in", "TimedLong", true, {"a", "b"}}, {"service", "", false}},
            .set = "fast",
            .sets = {{"default", {{"speed", "1"}}}, {"fast", {{"speed", "2"}}}, {"__widget__", {{"speed", "text"}}}}};
}

}  // namespace

TEST_CASE("an RTC is shown with state, ports and the set in use", "[openrtm][peers]") {
    CHECK(told({.name = "Out0"}, {.peers = {out0()}}) ==
          "rtm:pc.host_cxt/Out0  ConsoleOut, ACTIVE, set fast\n"
          "  in  in       TimedLong  2 connections\n"
          "      service  service    not connected\n"
          "  config.speed = 2\n"
          "  other sets: default");
}

TEST_CASE("an RTC whose execution context is stopped is shown as stopped", "[openrtm][peers]") {
    CHECK(told({}, {.peers = {{.name = "a", .type = "A", .state = PeerSnapshot::State::active, .is_stopped = true}}}) ==
          "rtm:a  A, ACTIVE, its execution context is stopped");
}

TEST_CASE("RTCs that are gone or hang are listed as such", "[openrtm][peers]") {
    const auto snapshot = [](const std::string& name, PeerSnapshot::State state) {
        return PeerSnapshot{.name = name, .state = state};
    };
    CHECK(told({}, {.peers = {snapshot("a", PeerSnapshot::State::gone), snapshot("b", PeerSnapshot::State::silent),
                              snapshot("c", PeerSnapshot::State::unasked)}}) ==
          "rtm:a  no longer exists: its program has crashed, and its name is still in the name service\n"
          "rtm:b  does not answer\n"
          "rtm:c  was not asked: too many others do not answer");
    CHECK(told({}, {}) == "the name service has no RTCs");
}

TEST_CASE("a request's result is shown by the new state", "[openrtm][peers]") {
    CHECK(told({.name = "Out0", .request = RtcRequest{}}, {.peers = {out0()}}) ==
          "rtm:pc.host_cxt/Out0  ConsoleOut, ACTIVE, set fast");
}

TEST_CASE("an unknown name is refused with the most similar one", "[openrtm][peers]") {
    CHECK(
        told({.name = "Out"},
             {.problem = "there is no RTC 'Out' in the name service", .missing = "Out", .known = {"Out0", "Mouse0"}}) ==
        "! there is no RTC 'Out' in the name service (did you mean 'Out0'?)");
}

TEST_CASE("names chosen by others can't look like lines of ours", "[openrtm][peers]") {
    PeerSnapshot snapshot = out0();
    snapshot.name = "a\nrtm:b  ACTIVE\x1b[2J";
    snapshot.ports.clear();
    snapshot.sets.clear();
    snapshot.set = "x\ny";
    CHECK(told({}, {.peers = {snapshot}}) == "rtm:a rtm:b  ACTIVE\\x1b[2J  ConsoleOut, ACTIVE, set x y");
}

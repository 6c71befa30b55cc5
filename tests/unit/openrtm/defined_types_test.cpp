// Ports of types that files define, as RTCs see them.
#include "tests/unit/openrtm/server_rig.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;

TEST_CASE("a type that a file defines is exported under the name that the file gives it", "[rtm][messages]") {
    const std::string system = R"(
behavior "seer" { script = "seer" }
rtm { export = { "seer" } }
)";
    const std::string seer = R"(
local given = input("given", "Obstacle")
local seen = output("seen", "Obstacle")
local plain = output("plain", "Plain")
function on_execute() if given.is_new then seen:write(given:read()) end end
)";
    const std::string obstacle = R"(return message "Obstacle" {
  rtm = "IDL:Seen/Obstacle:1.0",
  { "distance", "double", min = 0 },
  { "label", "string" },
})";
    const std::string plain = R"(return message "Plain" { { "number", "long" } })";
    ServerRig it(system, {{"seer", seer}, {"messages/obstacle", obstacle}, {"messages/plain", plain}});
    REQUIRE(it.told.profiles.size() == 1);
    const std::vector<RtcPort>& ports = it.told.profiles[0].ports;
    REQUIRE(ports.size() == 2);
    CHECK(ports[0].type == "Obstacle");
    CHECK(ports[0].type_id() == "IDL:Seen/Obstacle:1.0");
    it.told.wanted["seer.seen"] = {.little = true, .big = true};
    std::vector<std::uint8_t> bytes;
    write_cdr(bytes, {}, CdrTime{3, 0}, 0.5, std::string("box"));
    CHECK(it.server->put("seer.given", "Peer0.out", bytes, std::endian::little) == PutAnswer::taken);
    it.turn(3);
    REQUIRE(it.told.sent.size() == 2);
    CdrTime time;
    double distance = 0;
    std::string label;
    REQUIRE(read_cdr(it.told.sent[0].second, {}, time, distance, label));
    CHECK(distance == 0.5);
    CHECK(label == "box");
    REQUIRE(read_cdr(it.told.sent[1].second, {.order = std::endian::big}, time, distance, label));
    CHECK(label == "box");
    write_cdr(bytes, {}, CdrTime{3, 0}, -0.5, std::string("box"));
    CHECK(it.server->put("seer.given", "Peer0.out", bytes, std::endian::little) == PutAnswer::malformed);
}

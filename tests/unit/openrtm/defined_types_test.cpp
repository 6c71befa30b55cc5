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

TEST_CASE("an IDL structure without a stamp is exported and carried as it is", "[rtm][messages]") {
    const std::string seer = R"(
local given = input("given", "RTC/Velocity3D")
local seen = output("seen", "RTC/Velocity3D")
function on_execute() if given.is_new then seen:write(given:read()) end end
)";
    ServerRig it("behavior \"seer\" { script = \"seer\" }\nrtm { export = \"seer\" }\n", {{"seer", seer}});
    REQUIRE(it.told.profiles.size() == 1);
    REQUIRE(it.told.profiles[0].ports.size() == 2);
    CHECK(it.told.profiles[0].ports[0].type_id() == "IDL:RTC/Velocity3D:1.0");
    it.told.wanted["seer.seen"] = {.little = false, .big = true};
    std::vector<std::uint8_t> bytes;
    write_cdr(bytes, {.order = std::endian::big}, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
    CHECK(it.server->put("seer.given", "Peer0.out", bytes, std::endian::big) == PutAnswer::taken);
    it.turn(3);
    REQUIRE(it.told.sent.size() == 1);
    CHECK(it.told.sent[0].second == bytes);
    bytes.resize(40);
    CHECK(it.server->put("seer.given", "Peer0.out", bytes, std::endian::big) == PutAnswer::malformed);
}

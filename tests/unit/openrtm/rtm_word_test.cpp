// `rtm` in system files: what it takes, and how it is written.
#include "bindings/openrtm/rtm_word.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "bindings/lua/files/system_text.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;
using namespace nezumi::system_files;

TEST_CASE("rtm lists the exported components, and connections lead to RTCs", "[openrtm][system_file][rtm]") {
    const auto spec = system_of(
        "behavior 'c' { script = 'robot_controller' }\n"
        "rtm { nameserver = 'pc', export = { 'c' }, interface = '192.168.1.10', rename = { ['c.in'] = 'ir' } }\n"
        "connect('rtm:ConsoleOut0.out', 'c.in')\n"
        "connect('c.out', 'rtm:pc.host_cxt/RaspberryPiMouse0.target_velocity_in')");
    const RtmSpec* rtm = RtmWord::find(spec);
    REQUIRE(rtm != nullptr);
    CHECK(rtm->nameservers == std::vector<std::string>{"pc:2809"});
    CHECK(rtm->exported == std::vector<std::string>{"c"});
    CHECK(rtm->interface == "192.168.1.10");
    CHECK(rtm->rename == ParameterValues{{"c.in", std::string("ir")}});
    REQUIRE(spec.connections.size() == 2);
    CHECK(spec.connections[0].to == "c.in");
    CHECK(rtm_path(spec.connections[1].to) == RtmPath{"pc.host_cxt/RaspberryPiMouse0", "target_velocity_in"});

    const auto plain = system_of("behavior 'c' { script = 'robot_controller' }");
    CHECK(plain.peers.empty());
    const auto alone = system_of("behavior 'c' { script = 'robot_controller' } rtm { export = 'c' }");
    CHECK(RtmWord::find(alone)->nameservers == std::vector<std::string>{"localhost:2809"});
    CHECK(RtmWord::find(alone)->interface == "127.0.0.1");
}

TEST_CASE("rtm is written and read back", "[openrtm][system_text][rtm]") {
    const SystemSpec spec = system_of(
        "behavior 'c' { script = 'robot_controller' }\n"
        "rtm { export = 'c', nameserver = 'pc', rename = { ['c.in'] = 'ir' } }\n"
        "connect('rtm:Out0.out', 'c.in')");
    const std::string text = write_system_text(spec, "Exported");
    CHECK(text.find("rtm { export = { \"c\" }, nameserver = { \"pc:2809\" }, rename = { [\"c.in\"] = \"ir\" } }\n") !=
          std::string::npos);
    CHECK(text.find("connect(\"rtm:Out0.out\", \"c.in\")\n") != std::string::npos);
    CHECK(write_system_text(system_of(text), "Exported") == text);
}

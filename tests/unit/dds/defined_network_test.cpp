// Hosts whose definitions of a message type differ.
#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "tests/unit/dds/defined_types.hpp"
#include "tests/unit/dds/host_rig.hpp"

using namespace nezumi;
using namespace nezumi::dds;

namespace {

struct DefinedHost : HostRig {
    DefinedHost(Room& its_room, std::string name, const std::string& text) : HostRig(its_room, std::move(name)) {
        auto made = std::make_unique<Carrier>("eye", define(definition_of("Obstacle", text)));
        carrier = made.get();
        REQUIRE(system.add(std::move(made)));
        REQUIRE(carrier->activate(system.now()));
    }
    Carrier* carrier = nullptr;
};

// What the other host of a connection says, whose definition is `theirs`.
std::string refusal(const std::string& ours, const std::string& theirs) {
    Room room;
    DefinedHost ev3(room, "ev3", ours), pi(room, "pi", theirs);
    REQUIRE(pi.system.connect("ev3/eye.seen", "eye.given"));
    pass(room, 4, ev3, pi);
    const bool is_connected = !pi.connections().empty();
    CHECK(is_connected == !ev3.connections().empty());
    if (is_connected) return "";
    const std::string begin = "warn: connect(ev3/eye.seen, eye.given): host ev3 refuses: ";
    for (const std::string& line : pi.log) {
        if (line.starts_with(begin)) return line.substr(begin.size());
    }
    return "nothing was said";
}

}  // namespace

TEST_CASE("hosts whose definitions differ are not connected, and say the field that differs",
          "[dds][network][messages]") {
    const std::string known = "float64 distance # [m]\nstring label\n";
    CHECK(refusal(known, known) == "");
    CHECK(refusal(known, "float32 distance # [m]\nstring label\n") ==
          "the definitions of my_msgs/Obstacle differ: field 'distance' is number, also inf and nan [m] in "
          "ev3/eye.seen, and "
          "number from -3.403e+38 to 3.403e+38, also inf and nan [m] in pi/eye.given");
    CHECK(refusal(known, "float64 distance # [mm]\nstring label\n") ==
          "the definitions of my_msgs/Obstacle differ: field 'distance' is number, also inf and nan [m] in "
          "ev3/eye.seen, and "
          "number, also inf and nan [mm] in pi/eye.given");
    CHECK(refusal(known, "float64 distance # [m]\n") ==
          "the definitions of my_msgs/Obstacle differ: only ev3/eye.seen has field 'label'");
    CHECK(refusal(known, known + "uint8[] more\n") ==
          "the definitions of my_msgs/Obstacle differ: only pi/eye.given has field 'more'");
    CHECK(refusal(known, "string label\nfloat64 distance # [m]\n") ==
          "the definitions of my_msgs/Obstacle differ: its fields have another order");
}

TEST_CASE("definitions whose arrays have other lengths differ", "[dds][network][messages]") {
    for (const std::string kind : {"string", "bool", "uint8", "float64"}) {
        CAPTURE(kind);
        CHECK(refusal(kind + "[2] all\n", kind + "[3] all\n").find("differ: field 'all' is array of 2 ") !=
              std::string::npos);
        CHECK(refusal(kind + "[2] all\n", kind + "[] all\n") != "");
        CHECK(refusal(kind + "[2] all\n", kind + " all\n") != "");
    }
}

TEST_CASE("definitions that differ in their comments alone are connected", "[dds][network][messages]") {
    CHECK(refusal("float64 distance # [m] to the wall\n", "# Seen by an eye.\nfloat64 distance # [m]\n") == "");
}

TEST_CASE("a definition too large to announce is refused without its field", "[dds][network][messages]") {
    std::string large;
    for (std::size_t i = 0; i < most_message_fields - 10; ++i) large += "float32 x" + std::to_string(i) + "\n";
    const std::string text = refusal(large, large + "float32 more\n");
    CHECK(text.starts_with("the definitions of my_msgs/Obstacle differ: only pi/eye.given has field 'more'"));
    const std::string long_name(longest_name + 1, 'x');
    const std::string other = refusal("float32 " + long_name + "\n", "float64 " + long_name + "\n");
    CHECK(other.starts_with("types differ: ev3/eye.seen is my_msgs/Obstacle, pi/eye.given is my_msgs_Obstacle_"));
}

// Device nodes: kept open, used again after a loss, errors as text.
#include "hw/device/node.hpp"

#include <catch2/catch.hpp>
#include <cerrno>
#include <filesystem>
#include <fstream>

#include "hw/device/health.hpp"
#include "hw/raspimouse/advice.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("a regular file in a node's place has only the last write", "[hw][device]") {
    const Scratch folder;
    const auto file = folder.write("rtmotor_raw_l0", "");
    Node node(file.string(), Node::Access::write);
    REQUIRE(node.write("-400"));
    REQUIRE(node.write("7"));
    CHECK(text_of_file(file) == "7");
}

TEST_CASE("a node is read from its startning each time", "[hw][device]") {
    const Scratch folder;
    const auto file = folder.write("rtcounter_l0", "12\n");
    Node node(file.string(), Node::Access::read);
    CHECK(node.read() == "12\n");
    CHECK(node.read() == "12\n");
    std::ofstream(file) << "13\n";
    CHECK(node.read() == "13\n");
}

TEST_CASE("a missing node is used when it appears", "[hw][device]") {
    const Scratch folder;
    Node node(folder.path("rtled0").string(), Node::Access::write);
    const auto missing = node.write("1");
    REQUIRE_FALSE(missing);
    CHECK(missing.error().code == ENOENT);
    CHECK(describe(missing.error()) == folder.path("rtled0").string() + ": no such file or directory");
    folder.write("rtled0", "");
    CHECK(node.write("1"));
}

TEST_CASE("an empty node or a folder is an error", "[hw][device]") {
    const Scratch folder;
    Node empty(folder.write("empty", "").string(), Node::Access::read);
    CHECK(empty.read().error().code == EIO);
    folder.write("folder/file", "");
    Node node(folder.path("folder").string(), Node::Access::read);
    CHECK(node.read().error().code == EISDIR);
}

TEST_CASE("the error of a node says what to do", "[hw][device]") {
    CHECK(with_mouse_advice({"/dev/rtled0", ENOENT}) ==
          "/dev/rtled0: no such file or directory: is the driver loaded? Try: sudo modprobe rtmouse");
    CHECK(with_mouse_advice({"/dev/rtled0", EACCES}) ==
          "/dev/rtled0: permission denied: this user has no permission to use it. Try: sudo chmod a+rw /dev/rt*, or "
          "write a udev rule "
          "for it");
    CHECK(with_mouse_advice({"/dev/rtled0", EIO}) ==
          "/dev/rtled0: input/output error: look at the robot's power and cables, and at what dmesg says");
}

TEST_CASE("a loss is reported once, and the recovery once it has lasted", "[hw][device]") {
    Health health("LEDs");
    health.works(1);
    CHECK(health.take(10).empty());
    health.lost("gone");
    health.lost("still gone");
    CHECK(health.is_lost());
    CHECK(health.take(20) == std::vector<std::string>{"LEDs: gone"});
    health.works(21);
    CHECK_FALSE(health.is_lost());
    CHECK(health.take(21.9).empty());
    health.works(21.9);
    CHECK(health.take(22) == std::vector<std::string>{"LEDs: back again"});
    health.lost("gone again");
    CHECK(health.take(23) == std::vector<std::string>{"LEDs: gone again"});
}

TEST_CASE("a device that fails again and again is reported as lost, once", "[hw][device]") {
    Health health("LEDs");
    for (int i = 0; i < 10; ++i) {
        health.lost("gone");
        CHECK(health.take(i).size() == (i == 0 ? 1 : 0));
        health.works(i + 0.1);
        CHECK(health.take(i + 0.9).empty());
    }
    CHECK(health.take(10.5) == std::vector<std::string>{"LEDs: back again"});
}

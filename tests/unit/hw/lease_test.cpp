// Leases: only one program of a machine may drive a robot.
#include "hw/guard/lease.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "hw/guard/guard.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("only one program drives the motors, and a second one is refused with the reason", "[hw][guard][safety]") {
    const Scratch folder;
    const std::string node = folder.write("rtmotoren0", "").string();
    auto first = Guard::start("test", node);
    REQUIRE(first);
    const auto second = Guard::start("test", node);
    REQUIRE_FALSE(second);
    CHECK(second.error().message == node +
                                        ": another robot of this system drives these motors already: only one of "
                                        "them can be real, for example by --hw=NAME");
    first->reset();
    CHECK(Guard::start("test", node));
}

TEST_CASE("a robot's lease is still valid after its nodes were made again", "[hw][guard][safety]") {
    const Scratch folder;
    const auto node = folder.write("rtmotoren0", "1");
    auto guard = Guard::start("test", node.string());
    REQUIRE(guard);
    std::filesystem::remove(node);
    folder.write("rtmotoren0", "1");
    CHECK_FALSE(Lease::take("test", node.string()));
    CHECK(Lease::take("other", node.string()));
    // Also by another path to the same folder.
    std::filesystem::create_directory_symlink(folder.path(""), folder.path("same"));
    CHECK_FALSE(Lease::take("test", folder.path("same/rtmotoren0").string()));
}

TEST_CASE("a machine has one robot per driver for the kernel's nodes, by any path", "[hw][guard][safety]") {
    const std::string driver = "test " + std::to_string(getpid());  // other tests may run on this machine
    const auto nodes = Lease::take(driver, "/dev/null");
    REQUIRE(nodes);
    CHECK_FALSE(Lease::take(driver, "/dev/zero"));
    const auto sysfs = Lease::take(driver + " of sysfs", "/sys/class");
    REQUIRE(sysfs);
    CHECK_FALSE(Lease::take(driver + " of sysfs", "/sys/class/net"));
}

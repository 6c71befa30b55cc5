// A program that embeds nezumi has no peers, unless it brings their words.
#include <catch2/catch.hpp>
#include <string>

#include "bindings/embed/simulation.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

std::string refusal_of(const std::string& system) {
    const Scratch folder;
    const auto loaded = Simulation::load(folder.write("s.lua", system), {.installed = {source_root()}, .log = {}});
    return loaded ? "" : loaded.error().message;
}

}  // namespace

TEST_CASE("words for other hosts and other programs are unknown to a program without them", "[embed][peers]") {
    for (const std::string word : {"network", "ros", "rtm"}) {
        CAPTURE(word);
        CHECK_THAT(refusal_of(word + " { name = 'a' }"), Catch::Contains("unknown global '" + word + "'"));
    }
}

TEST_CASE("ports of other hosts and other programs can't be connected without their words", "[embed][peers]") {
    const std::string mouse = "robot 'mouse' { model = 'raspimouse' }\n";
    CHECK(refusal_of(mouse + "connect('rtm:Out0.out', 'mouse.target_velocity_in')") ==
          "connect: expected \"name.port\", got 'rtm:Out0.out'");
    CHECK(refusal_of(mouse + "connect('ev3/c.out', 'mouse.target_velocity_in')") ==
          "ev3/c.out is on another host: add network { name = ... } to the system file");
}

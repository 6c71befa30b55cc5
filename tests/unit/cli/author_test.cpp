// New behaviours for a running system's project.

#include <catch2/catch.hpp>
#include <filesystem>

#include "bindings/cli/new/behavior.hpp"
#include "bindings/console/session.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;

TEST_CASE("a new behaviour is written beside the others, with a scenario, and never over another", "[cli][new]") {
    const Scratch scratch;
    scratch.write("tests/scenarios/.keep", "");
    const BehaviorRequest request{
        .name = "follower", .inputs = {"light:TimedShortSeq"}, .outputs = {"out:TimedVelocity2D"}};
    const auto written = cli::write_new_behavior(scratch.path(), request);
    REQUIRE(written);
    CHECK(*written == std::vector<std::string>{"behaviors/follower.lua", "tests/scenarios/follower_test.lua"});
    for (const std::string& file : *written) CHECK(std::filesystem::exists(scratch.path(file)));
    CHECK_FALSE(cli::write_new_behavior(scratch.path(), request));
    const auto wrong = cli::write_new_behavior(scratch.path(), {.name = "other", .inputs = {"light:TimedShrt"}});
    REQUIRE_FALSE(wrong);
    CHECK(wrong.error().message.find("did you mean 'TimedShort'") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(scratch.path("behaviors/other.lua")));
}

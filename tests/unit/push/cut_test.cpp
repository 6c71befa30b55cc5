// A push that is cut at any step leaves the old project or the new one, and the next push finishes it or undoes it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>

#include "bindings/push/interrupted.hpp"
#include "tests/unit/push/second_push.hpp"

using namespace nezumi;
using namespace nezumi::push;

namespace {

namespace fs = std::filesystem;
using Tree = std::map<std::string, std::string>;

}  // namespace

TEST_CASE("a push that is killed at any disk call leaves the old project or the new one, and the next push finishes it",
          "[push][cut]") {
    bool was_old = false, was_new = false, was_finished = false;
    for (std::size_t at = 1;; ++at) {
        CAPTURE(at);
        const SecondPush push;
        const auto cut = push.robot.push_cut({.at = at});
        if (cut.calls < at) {
            REQUIRE(cut.sent);
            CHECK(at > 20);
            break;
        }
        CHECK_FALSE(cut.sent);
        // What runs there next finds one project, whole.
        REQUIRE(finish_interrupted_push(push.robot.there() / "behaviors/systems/x.lua"));
        const Tree found = tree_of(push.robot.there());
        CHECK((found == push.old_tree || found == push.new_tree));
        (found == push.old_tree ? was_old : was_new) = true;

        const SecondPush again;
        REQUIRE_FALSE(again.robot.push_cut({.at = at}).sent);
        const auto next = again.robot.push().sent;
        REQUIRE(next);
        was_finished = was_finished || next->has_finished;
        CHECK(tree_of(again.robot.there()) == again.new_tree);
        CHECK(again.robot.push().sent->changes.empty());
    }
    CHECK(was_old);
    CHECK(was_new);
    CHECK(was_finished);
}

TEST_CASE("a disk that is full at any size leaves the old project", "[push][cut]") {
    const SecondPush push;
    push.robot.scratch.write("robots/behaviors/changes.lua", std::string(5000, 'x'));
    for (const std::size_t bytes : {1, 5, 200, 600, 4999}) {
        CAPTURE(bytes);
        const auto full = push.robot.push_with_limit(bytes).sent;
        REQUIRE_FALSE(full);
        CHECK(full.error().message.find("can't be written: File too large: nothing was changed on the robot") !=
              std::string::npos);
        CHECK(tree_of(push.robot.there()) == push.old_tree);
    }
    REQUIRE(push.robot.push().sent);
    CHECK(tree_of(push.robot.there()).at("behaviors/changes.lua").size() == 5000);
}

// The examples of the documentation are files that can be read.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "bindings/lua/files/robot_file.hpp"
#include "bindings/lua/files/system_file.hpp"
#include "engine/base/whole_file.hpp"
#include "tests/unit/peer_words.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

// The Lua examples of a page.
std::vector<std::string> examples(const std::string& page) {
    const auto text = read_whole(root / "docs" / page, page);
    REQUIRE(text.has_value());
    std::vector<std::string> found;
    for (std::size_t at = 0; (at = text->find("```lua\n", at)) != std::string::npos;) {
        at += 7;
        const std::size_t end = text->find("```", at);
        REQUIRE(end != std::string::npos);
        found.push_back(text->substr(at, end - at));
        at = end + 3;
    }
    return found;
}

}  // namespace

TEST_CASE("the documentation's robots can be read", "[lua][docs]") {
    const Project project = Project::of(root / "behaviors/r.lua", {root});
    const auto all = examples("robot-files.md");
    CHECK(all.size() == 6);
    for (const std::string& text : all) {
        if (!text.starts_with("return")) continue;  // a system, below
        const auto robot = read_robot_text(text, "behaviors/r.lua", project);
        INFO((robot ? std::string() : describe(robot.error())));
        CHECK(robot.has_value());
    }
}

TEST_CASE("the documentation's systems can be read", "[lua][docs]") {
    const Project project = Project::of(root / "behaviors/s.lua", {root});
    auto all = examples("system-files.md");
    CHECK(all.size() == 4);
    for (const std::string& text : examples("camera-and-markers.md")) all.push_back(text);
    CHECK(all.size() == 7);
    for (const std::string& text : examples("robot-files.md")) {
        if (!text.starts_with("return")) all.push_back(text);
    }
    CHECK(all.size() == 8);
    for (const std::string& text : all) {
        const auto system = read_system_text(text, "behaviors/s.lua", project, {.peer_words = peer_words()});
        INFO((system ? std::string() : describe(system.error())));
        CHECK(system.has_value());
    }
}

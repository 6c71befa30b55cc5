// Robot files with a mistake: the message and its location.
#include <catch2/catch.hpp>

#include "tests/unit/lua/robot_reader.hpp"

using namespace nezumi;
using namespace nezumi::robot_files;

TEST_CASE("a file that is not a robot file is refused with one message", "[lua][robot_file][watchdog]") {
    CHECK(robot_error("") == "r.lua: a robot file must end with `return robot_model { ... }`");
    CHECK(robot_error(with("").substr(7)) == "r.lua: a robot file must end with `return robot_model { ... }`");
    CHECK(robot_error("return {}") == "r.lua: a robot file must end with `return robot_model { ... }`");
    CHECK(robot_error("return robot_model") == "r.lua: a robot file must end with `return robot_model { ... }`");
    CHECK(robot_error("return robot_model()") == "r.lua:1: robot_model: expected a table, got nil");
    CHECK(robot_error("return robot_model 'x'") == "r.lua:1: robot_model: expected a table, got string");
    CHECK(robot_error("local a = " + with("").substr(7) + "\n" + with("")) ==
          "r.lua:3: robot_model: a file can have only one, and line 1 has one already");
    CHECK_THAT(robot_error("return robot_modell {}"), Catch::StartsWith("r.lua:1:8: "));
    CHECK_THAT(robot_error("robot 'm' {}"), Catch::StartsWith("r.lua:1:1: "));
    CHECK_THAT(robot_error("return robot_model {"), Catch::StartsWith("r.lua:1: "));
    CHECK_THAT(robot_error("while true do end"), Catch::StartsWith("r.lua:1: "));
}

TEST_CASE("a check of a robot file reports every unknown global", "[lua][robot_file]") {
    const Project project = Project::of(root / "engine/robots/r.lua", {root});
    CHECK(check_robot_text(with(""), "r.lua", project).empty());
    const auto errors = check_robot_text("local a = taget\nreturn robot_modell {}", "r.lua", project);
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].place == Place{"r.lua", 1, 11});
    CHECK(errors[1].place == Place{"r.lua", 2, 8});
    CHECK(check_robot_text("return robot_model {}", "r.lua", project).size() == 1);
    CHECK(check_robot_text("", "r.lua", project).size() == 1);
}

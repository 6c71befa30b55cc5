// System files with a mistake: the message and its location.
#include <catch2/catch.hpp>

#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using namespace nezumi::system_files;

TEST_CASE("seed, rates and connections of a system file are read", "[lua][system_file]") {
    const auto spec = system_of("seed(42) rate(50) physics { step = 0.01 }");
    CHECK(spec.seed == 42);
    CHECK(spec.rate == 50);
    CHECK(spec.rate_place.line == 1);
    CHECK(spec.physics_step == 0.01);
    CHECK(system_of("seed(1e3)").seed == 1000);
    CHECK(system_of("seed(2^62)").seed == std::uint64_t{1} << 62);
    CHECK(system_of("rate(200)").rate == 200);
    CHECK(
        entry<BehaviorEntry>(system_of("behavior 'c' { script = 'robot_controller', rate = 200 } rate(200)"), 0).rate ==
        200);
    CHECK(system_of("connect('a.x', 'b.in') connect('a.x', 'c.in')").connections.size() == 2);
}

TEST_CASE("a file with a syntax error, a run-time error or an endless loop gives one message",
          "[lua][system_file][watchdog]") {
    CHECK_THAT(system_error("arena {\n  box {\n"), Catch::StartsWith("s.lua:"));
    CHECK_THAT(system_error("local a = nil\nlocal b = a.x"),
               Catch::StartsWith("s.lua:2: attempt to index a nil value"));
    CHECK(system_error("error('no arena today')") == "s.lua:1: no arena today");
    CHECK_THAT(system_error("\x1bLua"), Catch::Contains("bytecode"));
    CHECK(system_error("") == "s.lua: the file declares nothing: expected robot, behavior, arena, connect ...");
    const auto endless = read("while true do end", {.seconds = 0.05});
    REQUIRE_FALSE(endless.has_value());
    CHECK(endless.error().kind == Error::Kind::out_of_time);
    CHECK(endless.error().place.line == 1);
    CHECK_THAT(system_error("local t = {} t.t = t robot('m', t)"),
               Catch::Contains("nested too deeply, or a table is within itself"));
    CHECK_THAT(system_error("local t = {} for i = 1, 1e9 do t[i] = ('x'):rep(1e5) .. i end"),
               Catch::Contains("memory"));
}

TEST_CASE("a check of a system file reports every unknown global", "[lua][system_file]") {
    const Project project = Project::of(root / "behaviors/systems/s.lua", {root});
    CHECK(check_system_text("seed(1)", "s.lua", project).empty());
    const auto errors = check_system_text("sead(1)\nif false then\n  robott 'm' {}\nend", "s.lua", project);
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].place == Place{"s.lua", 1, 1});
    CHECK(errors[1].place == Place{"s.lua", 3, 3});
    CHECK(check_system_text("seed(-1) seed(-1)", "s.lua", project).size() == 1);
    CHECK(check_system_text("", "s.lua", project).size() == 1);
    CHECK(check_system_text("rate(60)", "s.lua", project).size() == 1);
}

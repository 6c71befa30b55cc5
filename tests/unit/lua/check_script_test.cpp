// A check tells all slips of a file at once.
#include "bindings/lua/script/check_script.hpp"

#include <catch2/catch.hpp>

using namespace nezumi;

namespace {

std::vector<std::string> check(const std::string& text) {
    std::vector<std::string> lines;
    for (const Error& error : check_behavior({"a.lua", "a.lua", text}, {})) lines.push_back(describe(error));
    return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("a check tells every slip that reading finds, in order of place", "[lua][check]") {
    CHECK(check("local function on_execute() end\nfunction on_exceute() pritn('x') end\ncount = 1") ==
          Lines{"a.lua:1:16: 'on_execute' is local, so it would never be called: leave out `local`",
                "a.lua:2:10: unknown callback 'on_exceute' (did you mean 'on_execute'?)",
                "a.lua:2:23: unknown global 'pritn' (did you mean 'print'?)",
                "a.lua:3:1: unknown global 'count' (declare it first: local count)"});
}

TEST_CASE("what only loading finds is told when nothing else is wrong", "[lua][check]") {
    CHECK(check("input('in', 'TimedShrt')") == Lines{"a.lua:1: input 'in': unknown type 'TimedShrt' (did you mean "
                                                     "'TimedShort'?); `nezumi types` lists them all"});
    CHECK(check("") == Lines{"a.lua: the file declares nothing: no port, parameter, command, task or callback"});
    CHECK(check("input('in', 'TimedShort')").empty());
}

TEST_CASE("a parameter that is read and not declared is told before its line runs", "[lua][check]") {
    CHECK(check("param('speed', 1)\n"
                "function on_execute()\n"
                "  if config.speed > 1 then return config.sped end\n"
                "  config . turn = 2\n"
                "  local t = { config = { any = 1 } }\n"
                "  local config = t.config\n"
                "  return config.any, t.config.any, config['other']\n"
                "end") == Lines{"a.lua:3:42: config: unknown parameter 'sped' (did you mean 'speed'?)",
                                "a.lua:4:12: config: unknown parameter 'turn'"});
}

TEST_CASE("a module is checked by reading it", "[lua][check]") {
    CHECK(check_module({"m.lua", "m.lua", "return { f = function() return 1 end }"}).empty());
    const auto errors = check_module({"m.lua", "m.lua", "function helper() end"});
    REQUIRE(errors.size() == 1);
    CHECK(describe(errors[0]) == "m.lua:1:10: unknown global 'helper' (declare it first: local helper)");
}

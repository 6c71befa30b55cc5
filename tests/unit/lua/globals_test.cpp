// Every global that a text names is found, and no local is taken for one.
#include <catch2/catch.hpp>

#include "sandbox_support.hpp"

namespace nezumi {
namespace {

std::string uses(std::string_view source) {
    REQUIRE(compile(source, "a.lua"));
    std::string list;
    const SyntaxTree tree(without_preamble(source));
    for (const GlobalUse& use : global_uses(tree)) {
        list += (list.empty() ? "" : " ") + std::string(use.name()) + (use.assigned ? "=" : "") + "@" +
                std::to_string(use.node->first->line) + ":" + std::to_string(use.node->first->column);
    }
    return list;
}

TEST_CASE("a global is found in every place", "[lua][syntax]") {
    CHECK(uses("x = y") == "x=@1:1 y@1:5");
    CHECK(uses("f(a, b.c, d[e], g:h(i), { j, k = l, [m] = n; o })") ==
          "f@1:1 a@1:3 b@1:6 d@1:11 e@1:13 g@1:17 i@1:21 j@1:27 l@1:34 m@1:38 n@1:43 o@1:46");
    CHECK(uses("a.b = c") == "a@1:1 c@1:7");
    CHECK(uses("a, b.c, d = e") == "a=@1:1 b@1:4 d=@1:9 e@1:13");
    CHECK(uses("function f() end function g.h() end function i:j() end") == "f=@1:10 g@1:27 i@1:46");
    CHECK(uses("if a then b() elseif c then d() else e() end while f do g() end repeat h() until i") ==
          "a@1:4 b@1:11 c@1:22 d@1:29 e@1:38 f@1:52 g@1:57 h@1:72 i@1:82");
    CHECK(uses("for i = a, b, c do d(i) end for k, v in e, f do g(k, v) end") ==
          "a@1:9 b@1:12 c@1:15 d@1:20 e@1:41 f@1:44 g@1:49");
    CHECK(uses("return not a, -b, #c, ~d, a and b or c .. d, function(x) return x, y end") ==
          "a@1:12 b@1:16 c@1:20 d@1:24 a@1:27 b@1:33 c@1:38 d@1:43 y@1:68");
    CHECK(uses("f 'text' g [[text]] h { x } (i)()") == "f@1:1 g@1:10 h@1:21 x@1:25 i@1:30");
    CHECK(uses("f'a'.b[c]:d{e}.g = h") == "f@1:1 c@1:8 e@1:13 h@1:20");
    CHECK(uses("\n\n  x\n  =\n\ty\r\nz()") == "x=@3:3 y@5:2 z@6:1");
    CHECK(uses("goto done x() ::done:: do local x x() end") == "x@1:11");
}

TEST_CASE("a local variable is not a global", "[lua][syntax]") {
    CHECK(uses("local x = x x = 1") == "x@1:11");
    CHECK(uses("local function f() f() end f()") == "");
    CHECK(uses("local f = function() f() end") == "f@1:22");
    CHECK(uses("local a <const>, b <close> = 1, nil return a, b") == "");
    CHECK(uses("do local x end x()") == "x@1:16");
    CHECK(uses("local x do local x end return x") == "");
    CHECK(uses("repeat local x until x") == "");
    CHECK(uses("while true do local x break end x()") == "x@1:33");
    CHECK(uses("for x = x, 1 do x() end x()") == "x@1:9 x@1:25");
    CHECK(uses("for x in x do local x = x end") == "x@1:10");
    CHECK(uses("function f(x, ...) return x, ... end return x") == "f=@1:10 x@1:45");
    CHECK(uses("local t function t.f(x) return self end function t:g(x) return self, x end") == "self@1:32");
    CHECK(uses("if a then local b elseif b then end") == "a@1:4 b@1:26");
    CHECK(uses("local t = { x = 1, y = function(x) return x end } return t.x, t.y, t:z()") == "");
    CHECK(uses("goto x ::x::") == "");
}

TEST_CASE("comments, strings and numbers contain no globals", "[lua][syntax]") {
    CHECK(uses("-- x\n--[[ x\n x ]] --[==[ x ]] ]==] y()") == "y@3:24");
    CHECK(uses("y('x', \"x\\\" x\", [[x]], [==[ x ]] ]==], 'a\\\nb', 'a\\z  \n  b')") == "y@1:1");
    CHECK(uses("y(0x1p4, 1e5, 1E-5, 3., .5, 0xAp-2, 0xep1, 1//2, 1 ..z)") == "y@1:1 z@1:54");
    CHECK(uses("y = [[\nx\n]] z()") == "y=@1:1 z@3:4");
    CHECK(uses("#!/usr/bin/lua x\ny()").find("x") == std::string::npos);
    CHECK(uses("\xEF\xBB\xBFy()") == "y@1:1");
    CHECK(uses("y(a.x, a . x, a.\nx, a:x(), a : x())") == "y@1:1 a@1:3 a@1:8 a@1:15 a@2:4 a@2:11");
}

std::string errors(std::string_view source) {
    const KnownGlobals known{{"print", "math", "output"}, {"on_execute", "on_activated"}};
    const auto chunk = compile_checked(source, "robot_controller.lua", known);
    std::string list;
    if (!chunk) {
        for (const Error& error : chunk.error()) list += (list.empty() ? "" : "\n") + describe(error);
    }
    return list;
}

TEST_CASE("_ENV can't be used", "[lua][syntax]") {
    const char* const text =
        GENERATE(as<const char*>{}, "_ENV = {}", "_ENV.x = 1", "local _ENV = {}", "local function f(_ENV) x = 1 end",
                 "print(_ENV)", "for _ENV in print do end", "for _ENV = 1, 2 do end", "local a, _ENV = 1, {}",
                 "function _ENV.f() end", "return _ENV['x']", "local t <const>, _ENV <const> = 1, 2",
                 "local function _ENV() end", "local f = function() return function() return _ENV end end", "_ENV:x()",
                 "function _ENV:f() end", "return (_ENV)");
    CAPTURE(text);
    CHECK(errors(text).find("'_ENV' can't be used: write the names of globals directly") != std::string::npos);
    CHECK(errors("local t = { _ENV = 1 } print(t._ENV, t:_ENV(), '_ENV', [[_ENV]]) -- _ENV") == "");
}

TEST_CASE("globals are found in a chunk with more constants than an instruction can name", "[lua][syntax]") {
    std::string source = "local t = {}\n";
    for (int i = 0; i < 400; ++i) source += "t.field" + std::to_string(i) + " = " + std::to_string(i) + ".5\n";
    source += "taget(1)\nspeeed = 2\n";
    const KnownGlobals known{{"print"}, {}};
    const auto chunk = compile_checked(source, "a.lua", known);
    REQUIRE_FALSE(chunk);
    REQUIRE(chunk.error().size() == 2);
    CHECK(describe(chunk.error()[0]) == "a.lua:402:1: unknown global 'taget'");
    CHECK(describe(chunk.error()[1]) == "a.lua:403:1: unknown global 'speeed' (declare it first: local speeed)");
}

}  // namespace
}  // namespace nezumi

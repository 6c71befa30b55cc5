// What a file says of itself.
#include <catch2/catch.hpp>

#include "bindings/lua/syntax/first_comment.hpp"
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

TEST_CASE("the first comment is the comment lines at the begin, without their dashes", "[lua][component]") {
    CHECK(first_comment("--- Drives.\nlocal x") == "Drives.");
    CHECK(first_comment("\n  -- One,\r\n--\n--two.  \n\n-- not this\n") == "One,\n\ntwo.");
    CHECK(first_comment("-----\n-- Title\n-----\nlocal x") == "Title");
    CHECK(first_comment("#!/usr/bin/env lua\n-- After the shell's line.") == "After the shell's line.");
    CHECK(first_comment("local x -- not this").empty());
    CHECK(first_comment("--[[ not this ]] local x").empty());
    CHECK(first_comment("").empty());
    CHECK(first_comment("--").empty());
}

TEST_CASE("a long first comment is cut at the end of a line", "[lua][component]") {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "-- line\n";
    const std::string taken = first_comment(text);
    CHECK(taken.size() < 2000);
    CHECK(taken.ends_with("\nline"));
    CHECK(first_comment("-- " + std::string(5000, 'x')).empty());
}

TEST_CASE("a script has the first comment of its file", "[lua][component]") {
    const ScriptRig rig("--- Does nothing.\nparam('x', 1)");
    CHECK(rig.component->script().doc() == "Does nothing.");
}

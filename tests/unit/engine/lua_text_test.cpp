// How texts and numbers are written for Lua.
#include "engine/base/lua_text.hpp"

#include <catch2/catch.hpp>

#include <limits>

namespace nezumi {
namespace {

TEST_CASE("a text for Lua is on one line, and bytes that a terminal can't show are escaped", "[engine][lua_text]") {
    CHECK(lua_quoted("") == R"("")");
    CHECK(lua_quoted("say \"hi\" \\ K\xC3\xA4se") == "\"say \\\"hi\\\" \\\\ K\xC3\xA4se\"");
    CHECK(lua_quoted("two\nlines\t\x7f") == R"("two\nlines\x09\x7f")");
    CHECK(lua_quoted(std::string_view("a\0"
                                      "1",
                                      3)) == R"("a\x001")");
}

TEST_CASE("every text comes back from its quotes", "[engine][lua_text]") {
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    CHECK(lua_unquoted(lua_quoted(all)) == all);
    for (const std::string text : {"", "\\n", "\\x41", "\\", "\"",
                                   "\x01"
                                   "23",
                                   "\n\n"})
        CHECK(lua_unquoted(lua_quoted(text)) == text);
}

TEST_CASE("an integer is written with a fraction: 2.0", "[engine][lua_text]") {
    CHECK(lua_number(0.25) == "0.25");
    CHECK(lua_number(2) == "2.0");
    CHECK(lua_number(-0.0) == "-0.0");
    CHECK(lua_number(1e300) == "1e+300");
    CHECK(lua_number(0.1 + 0.2) == "0.30000000000000004");
}

TEST_CASE("infinity and NaN are written as Lua prints them", "[engine][lua_text]") {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    CHECK(lua_number(infinite) == "inf");
    CHECK(lua_number(-infinite) == "-inf");
    CHECK(lua_number(std::numeric_limits<double>::quiet_NaN()) == "nan");
    CHECK(lua_number(-std::numeric_limits<double>::quiet_NaN()) == "nan");
}

}  // namespace
}  // namespace nezumi

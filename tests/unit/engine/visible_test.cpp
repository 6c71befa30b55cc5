// What a script or a folder's name can't do to a terminal or a log.
#include "engine/base/visible.hpp"

#include <catch2/catch.hpp>

using nezumi::visible;
using nezumi::visible_message;

TEST_CASE("control characters are written out for a terminal", "[engine][base]") {
    CHECK(visible("a\tb\nc") == "a\tb\nc");
    CHECK(visible("\x1b[31mred\x07\x7f\r") == "\\x1b[31mred\\x07\\x7f\\x0d");
    CHECK(visible("\xC2\x9B"
                  "31m \xC3\xBC") == "\\x9b31m \xC3\xBC");
    CHECK(visible("\xC2'") == "\xC2'");  // half a character, and another one
    CHECK(visible(std::string_view("a\0b", 3)) == "a\\x00b");
}

TEST_CASE("characters that turn the direction of writing are written out", "[engine][base]") {
    CHECK(visible("systems\xE2\x80\xAE"
                  "aul.") == "systems\\u202eaul.");
    CHECK(visible("\xE2\x80\x8F\xE2\x80\xA8\xE2\x81\xA6\xE2\x81\xA9") == "\\u200f\\u2028\\u2066\\u2069");
    // Dashes, quotes, blanks, letters of any script, and bytes that are not text.
    const std::string harmless = "\xE2\x80\x94 \xE2\x80\x9C \xE2\x80\xAF \xE3\x83\x8D\xD7\xA9 \xE2\x80 \xFF \xE2";
    CHECK(visible(harmless) == harmless);
}

TEST_CASE("a line break in a message begins no line of the log", "[engine][base]") {
    CHECK(visible_message("one\n[    0.010] error mouse: burns\n\x1b") ==
          "one\n            | [    0.010] error mouse: burns\n            | \\x1b");
    CHECK(visible_message("one") == "one");
}

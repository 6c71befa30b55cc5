// Rows of an input, and candidates in columns.
#include "bindings/terminal/text_layout.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace nezumi;

TEST_CASE("the cursor's row is the terminal's", "[console][layout]") {
    CHECK(row_after(L"", 10) == 0);
    CHECK(row_after(std::wstring(9, L'x'), 10) == 0);
    CHECK(row_after(std::wstring(10, L'x'), 10) == 1);
    CHECK(row_after(std::wstring(25, L'x'), 10) == 2);
    CHECK(row_after(L"a\nb\nc", 10) == 2);
    CHECK(row_after(L"12345678\t", 20) == 0);
    CHECK(row_after(L"12345678\t", 16) == 1);
    CHECK(row_after(L"123456789\x01", 10) == 1);
}

TEST_CASE("candidates share a beginning, of whole characters", "[console][layout]") {
    CHECK(common_beginning({"speed_r", "speed_x"}) == "speed_");
    CHECK(common_beginning({"mouse"}) == "mouse");
    CHECK(common_beginning({"a", "b"}).empty());
    CHECK(common_beginning({"x\xC3\xBC", "x\xC3\xB6"}) == "x");
    CHECK(common_beginning({"x\xC3\xBC", "x\xC3\xBCy"}) == "x\xC3\xBC");
}

TEST_CASE("candidates are listed downwards in columns", "[console][layout]") {
    CHECK(in_columns({"a", "bb", "ccc"}, 80) == "a    bb   ccc\n");
    CHECK(in_columns({"a", "bb", "ccc"}, 10) == "a    ccc\nbb\n");
    CHECK(in_columns({"longer than the terminal"}, 10) == "longer than the terminal\n");
    std::vector<std::string> many;
    many.reserve(250);
    for (int count = 0; count < 250; ++count) many.push_back(std::to_string(count));
    CHECK(in_columns(many, 80).ends_with("\nand 50 more\n"));
}

// Fields and rows of CSV: what is written is read again.
#include "engine/base/csv.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using namespace nezumi;

namespace {

using Fields = std::vector<std::string>;

Fields texts_of(std::string_view row) {
    Fields texts;
    const auto fields = split_csv_row(row);
    REQUIRE(fields);
    for (const std::string_view field : *fields) texts.push_back(csv_text(field));
    return texts;
}

}  // namespace

TEST_CASE("any text is read as it was written", "[engine][csv]") {
    const Fields all{"", "plain", "a,b", "\"", "\"\"", "say \"hi\", twice", "two\nlines", " blanks "};
    std::string row;
    for (const std::string& text : all) row += (row.empty() ? "" : ",") + csv_quoted(text);
    CHECK(texts_of(row) == all);
    std::istringstream in(row + "\nnext,row\n");
    std::string read;
    REQUIRE(read_csv_row(in, read));
    CHECK(read == row);
    REQUIRE(read_csv_row(in, read));
    CHECK(read == "next,row");
    CHECK_FALSE(read_csv_row(in, read));
}

TEST_CASE("blanks around a field don't count, and quotes only where it begins", "[engine][csv]") {
    CHECK(texts_of(" 1 ,\t2\r, \"a,b\" ,c\"d,") == Fields{"1", "2", "a,b", "c\"d", ""});
    CHECK(texts_of("\"a\"b,c") == Fields{"ab", "c"});
    CHECK(split_csv_row("1, 2") == std::vector<std::string_view>{"1", " 2"});
    CHECK_FALSE(split_csv_row("1,\"2,3"));
}

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
    std::vector<std::string> fields;
    for (const std::string& text : all) fields.push_back(csv_field(text));
    CHECK(texts_of(csv_row(fields)) == all);
    std::istringstream in(row + "\nnext,row\n");
    std::string read;
    REQUIRE(read_csv_row(in, read));
    CHECK(read == row);
    REQUIRE(read_csv_row(in, read));
    CHECK(read == "next,row");
    CHECK_FALSE(read_csv_row(in, read));
}

TEST_CASE("a field is in quotes only where it needs them", "[engine][csv]") {
    CHECK(csv_field("controller.out.vx") == "controller.out.vx");
    CHECK(csv_field("say \"hi\", twice") == "\"say \"\"hi\"\", twice\"");
    CHECK(csv_field(" blanks ") == "\" blanks \"");
    CHECK(csv_row(std::vector<std::string>{"time", "", csv_field("a,b")}) == "time,,\"a,b\"");
}

TEST_CASE("a row ends at the first end of line that is not in quotes", "[engine][csv]") {
    CHECK(end_of_csv_row("1,2\n3", 0) == 4);
    CHECK(end_of_csv_row("1,\"a\nb\"\n3\n", 0) == 8);
    CHECK(end_of_csv_row("1,\"a\nb\"\n3\n", 8) == 10);
    CHECK(end_of_csv_row("wide: 5\"\n3\n", 0) == 9);
    CHECK_FALSE(end_of_csv_row("1,\"a\nb", 0));
    CHECK_FALSE(end_of_csv_row("1,2", 0));
    CHECK_FALSE(end_of_csv_row("", 0));
}

TEST_CASE("blanks around a field don't count, and quotes only where it begins", "[engine][csv]") {
    CHECK(texts_of(" 1 ,\t2\r, \"a,b\" ,c\"d,") == Fields{"1", "2", "a,b", "c\"d", ""});
    CHECK(texts_of("\"a\"b,c") == Fields{"ab", "c"});
    CHECK(split_csv_row("1, 2") == std::vector<std::string_view>{"1", " 2"});
    CHECK_FALSE(split_csv_row("1,\"2,3"));
}

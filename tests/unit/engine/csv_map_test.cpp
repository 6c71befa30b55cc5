// Maps in CSV: accepted forms, and the message about a bad row.
#include <catch2/catch.hpp>

#include "engine/world/csv_map.hpp"

using namespace nezumi;

namespace {

CsvMap map_of(std::string_view text) {
    auto read = read_map(text, "map.csv");
    INFO((read ? std::string() : describe(read.error())));
    REQUIRE(read.has_value());
    return *read;
}

std::vector<BoxSpec> boxes(std::string_view text) { return map_of(text).boxes; }

std::string map_error(std::string_view text) {
    const auto read = read_map(text, "map.csv");
    return read ? "no error" : describe(read.error());
}

const std::string header = "x,y,z,lx,ly,lz,yaw\n";

}  // namespace

TEST_CASE("every row of a map is a fixed box", "[engine][csv]") {
    const auto read = boxes("x,y,z,lx,ly,lz,yaw\n0.5,-1,0.1,0.2,0.3,0.4,1.57\n1,2,3,4,5,6,-7\n");
    REQUIRE(read.size() == 2);
    CHECK(read[0].at == Point3D{0.5, -1, 0.1});
    CHECK(read[0].size == Point3D{0.2, 0.3, 0.4});
    CHECK(read[0].yaw == 1.57);
    CHECK(read[0].mass == 0);
    CHECK(read[0].place == Place{"map.csv", 2});
    CHECK(read[1].yaw == -7);
    CHECK(read[1].place.line == 3);
}

TEST_CASE("a map's lines end as those of any computer", "[engine][csv]") {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        INFO(end.size());
        const auto read = boxes("x,y,z,lx,ly,lz,yaw" + end + "1,2,3,4,5,6,7" + end + "2,2,3,4,5,6,7" + end);
        REQUIRE(read.size() == 2);
        CHECK(read[1].at.x == 2);
        CHECK(read[1].place.line == 3);
    }
}

TEST_CASE("a map's first line is skipped, with any content in any encoding", "[engine][csv]") {
    const std::string row = "\n1,2,3,4,5,6,7\n";
    // As the old simulator's own map has it, in Shift-JIS.
    for (const std::string first :
         {"\x92\x86\x90\x53x,\x92\x86\x90\x53y,\x92\x86\x90\x53z,\x92\xb7\x82\xb3,\x95\x9d,\x8d\x82\x82\xb3,"
          "\x8a\x70\x93\x78",
          "a map", "", "\"not closed", "x;y;z", "x,y,z,lx,ly,lz,yaw,colour,colour"}) {
        CAPTURE(first);
        const auto read = map_of(first + row);
        REQUIRE(read.boxes.size() == 1);
        CHECK(read.boxes[0].at == Point3D{1, 2, 3});
        CHECK(read.boxes[0].size == Point3D{4, 5, 6});
        CHECK(read.boxes[0].yaw == 7);
        CHECK(read.boxes[0].place.line == 2);
        CHECK(read.skipped == 0);
        CHECK_FALSE(read.header_is_numbers);
    }
    CHECK(map_of("1,2,3,4,5,6,7" + row).header_is_numbers);
    CHECK(map_error("") == "map.csv: is empty: expected a header line, then rows x,y,z,lx,ly,lz,yaw");
}

TEST_CASE("a map's further columns are ignored, and its comments, blank and short rows skipped and counted",
          "[engine][csv]") {
    const auto read =
        map_of(header +
               "1,2,3,4,5,6,7,red,9\n# walls, of, the, room, in, the, east, wing\n\nnorth\n1,2,3\n,,,,,,,\n \t\n"
               "1,2,3,4,5,6,7,,\n");
    CHECK(read.boxes.size() == 2);
    CHECK(read.skipped == 6);
    CHECK(describe(read, "map.csv") == "map.csv: 2 boxes, 6 lines that are not boxes skipped");
    CHECK(describe(map_of(header + "# a wall\n1,2,3,4,5,6,7\n"), "m") == "m: 1 box, 1 line that is not a box skipped");
    CHECK(describe(map_of("7,6,5,4,3,2,1\n1,2,3,4,5,6,7\n"), "m") ==
          "m: 1 box; its first line, which is skipped as a header, reads like a box");
}

TEST_CASE("a map may come from a spreadsheet on any system", "[engine][csv]") {
    const auto read = boxes(
        "\xef\xbb\xbfx, y ,z,lx,ly,lz,\"yaw\",,\r\n\r\n# a wall\r\n \"1\" ,+2,3e0,4,.5,6,0,,\r\n,,,,,,\r\n  "
        "\r\n1,2,3,4,5,6,7");
    REQUIRE(read.size() == 2);
    CHECK(read[0].at == Point3D{1, 2, 3});
    CHECK(read[0].size == Point3D{4, 0.5, 6});
    CHECK(read[0].place.line == 4);
    CHECK(read[1].place.line == 7);
}

TEST_CASE("a header that names the columns of a map in another order is obeyed", "[engine][csv]") {
    for (const char* first : {"yaw,lz,ly,lx,z,y,x", "\xef\xbb\xbfYaw, LZ ,ly,lx,z,y,x", "yaw,lz,ly,lx,z,y,x,name"}) {
        const auto read = boxes(std::string(first) + "\n7,6,5,4,3,2,1,door\n");
        REQUIRE(read.size() == 1);
        CHECK(read[0].at == Point3D{1, 2, 3});
        CHECK(read[0].size == Point3D{4, 5, 6});
        CHECK(read[0].yaw == 7);
    }
    CHECK(boxes("name,x,y,z,lx,ly,lz,yaw\ndoor,1,2,3,4,5,6,7\n").size() == 1);
    CHECK(map_error("yaw,lz,ly,lx,z,y,x\n0,0,1,1,0,0,0\n") ==
          "map.csv:2: column 'lz': expected a positive number, got '0'");
}

TEST_CASE("a map without a box gives an error that names the separator of its columns", "[engine][csv]") {
    CHECK(map_error("x;y;z;lx;ly;lz;yaw\n1;2;3;4;5;6;7\n") ==
          "map.csv:2: expected rows x,y,z,lx,ly,lz,yaw, got columns that are separated by semicolons: separate them by "
          "commas");
    CHECK(map_error("x;y;z;lx;ly;lz;yaw\n1,5;2,0;3,0;4,0;5,0;6,0;7,0\n") ==
          "map.csv:2: expected rows x,y,z,lx,ly,lz,yaw, got columns that are separated by semicolons: separate them by "
          "commas");
    CHECK(
        map_error("x\ty\tz\tlx\tly\tlz\tyaw\n# walls\n1\t2\t3\t4\t5\t6\t7\n") ==
        "map.csv:3: expected rows x,y,z,lx,ly,lz,yaw, got columns that are separated by tabs: separate them by commas");
    CHECK(map_error("x,y,z,lx,ly,lz\n1,2,3,4,5,6\n") == "map.csv:2: expected rows x,y,z,lx,ly,lz,yaw, got 6 columns");
    CHECK(map_error(header + "north\n") == "map.csv:2: expected rows x,y,z,lx,ly,lz,yaw, got 1 column");
}

TEST_CASE("a map without a box is an error", "[engine][csv]") {
    const std::string none = "map.csv: expected rows x,y,z,lx,ly,lz,yaw, got none";
    CHECK(map_error(header) == none);
    CHECK(map_error("x,y,z,lx,ly,lz,yaw") == none);
    CHECK(map_error(header + "# a wall\n\n") == none);
    CHECK(map_error("1,2,3,4,5,6,7\n") == none + ": the first line, which reads like a box, is skipped as a header");
}

TEST_CASE("an error in a field of a map has the line, the column and the expected value", "[engine][csv]") {
    CHECK(map_error(header + "1,2,3,4,5,6,7\n\n0,0,0,abc,1,1,0\n") ==
          "map.csv:4: column 'lx': expected a positive number, got 'abc'");
    CHECK(map_error(header + "0,0,0,1,1,0,0\n") == "map.csv:2: column 'lz': expected a positive number, got '0'");
    CHECK(map_error(header + "0,0,0,1,-1,1,0\n") == "map.csv:2: column 'ly': expected a positive number, got '-1'");
    CHECK(map_error(header + "0,,0,1,1,1,0\n") == "map.csv:2: column 'y': expected a number, got ''");
    CHECK(map_error(header + "0,0,0,1,1,1,nan\n") == "map.csv:2: column 'yaw': expected a number, got 'nan'");
    CHECK(map_error(header + "inf,0,0,1,1,1,0\n") == "map.csv:2: column 'x': expected a number, got 'inf'");
    CHECK(map_error(header + "1e999,0,0,1,1,1,0\n") == "map.csv:2: column 'x': expected a number, got '1e999'");
    CHECK(map_error(header + "0,0,0,1e300,1,1,0\n") ==
          "map.csv:2: column 'lx': expected a number up to 1000000, got '1e300'");
    CHECK(map_error(header + "-2e6,0,0,1,1,1,0\n") ==
          "map.csv:2: column 'x': expected a number from -1000000 on, got '-2e6'");
    CHECK(map_error(header + "0,0,0x10,1,1,1,0\n") == "map.csv:2: column 'z': expected a number, got '0x10'");
    CHECK(map_error(header + "0,0,+-1,1,1,1,0\n") == "map.csv:2: column 'z': expected a number, got '+-1'");
    CHECK(map_error(header + "0,0,1 2,1,1,1,0\n") == "map.csv:2: column 'z': expected a number, got '1 2'");
    CHECK(map_error(header + "\"1\"\"\",0,0,1,1,1,0\n") == "map.csv:2: column 'x': expected a number, got '1\"'");
}

TEST_CASE("a quote that is not closed is a matter of comments and further columns of a map", "[engine][csv]") {
    const auto read = map_of(header +
                             "\"comment\n1,2,3,4,5,6,7,\"unclosed\n\"wall, by, the, door, and, so, on\n"
                             "1,2,3,4,5,6,7,red,\"two\nlines\"\n  \"\n");
    REQUIRE(read.boxes.size() == 2);
    for (const BoxSpec& box : read.boxes) CHECK(box.yaw == 7);
    CHECK(read.boxes[1].place.line == 5);
    CHECK(read.skipped == 4);
    CHECK_FALSE(map_of("x,y,z,\"\n1,2,3,4,5,6,7\n").header_is_numbers);
    CHECK(map_of("1,2,3,4,5,6,7,\"note\n1,2,3,4,5,6,7\n").header_is_numbers);
}

TEST_CASE("a box of a map that a quote which is not closed would hide is refused", "[engine][csv]") {
    for (const char* row : {"\"1,2,3,4,5,6,7", "1,2,3,4,5,6,\"7", "1,\"2,3,4,5,6,7,red", "\"1\",\"2\",3,4,5,\"6,7"})
        CHECK(map_error(header + row + "\n") == "map.csv:2: a quote is not closed");
    CHECK(boxes(header + "# \"1,2,3,4,5,6,7\n\"1,2,3,4,5,6,7\"\n1,2,3,4,5,6,7\n").size() == 1);
    CHECK(map_error(header + "1,2,3,4,5,6,\n") == "map.csv:2: column 'yaw': expected a number, got ''");
}

TEST_CASE("bytes that are not text stay out of a map's messages", "[engine][csv]") {
    CHECK(map_error(header + "a\x1b[2J\x01,0,0,1,1,1,0\n") ==
          "map.csv:2: column 'x': expected a number, got 'a\\x1b[2J\\x01'");
    CHECK(map_error(header + std::string(100, 'q') + ",0,0,1,1,1,0\n") ==
          "map.csv:2: column 'x': expected a number, got '" + std::string(60, 'q') + "...'");
}

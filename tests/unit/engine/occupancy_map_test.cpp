// Maps of ROS: accepted forms, the places of the boxes, and the message about a bad map.
#include "engine/world/occupancy_map.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>

using namespace nezumi;

namespace {

const std::string yaml = "image: map.pgm\nresolution: 0.05\norigin: [-1.0, -2.0, 0.0]\n";

OccupancyFacts facts_of(std::string_view text) {
    auto facts = read_occupancy_facts(text, "map.yaml");
    INFO((facts ? std::string() : describe(facts.error())));
    REQUIRE(facts.has_value());
    return *facts;
}

std::string facts_error(const std::string& text) {
    const auto facts = read_occupancy_facts(text, "map.yaml");
    return facts ? "no error" : describe(facts.error());
}

// A picture of these rows: '#' black, '?' grey, '.' white.
std::string picture(const std::vector<std::string>& rows) {
    std::string bytes =
        "P5\n# by hand\n" + std::to_string(rows.front().size()) + " " + std::to_string(rows.size()) + "\n255\n";
    for (const std::string& row : rows) {
        for (const char c : row) bytes += static_cast<char>(c == '#' ? 0 : c == '?' ? 205 : 254);
    }
    return bytes;
}

OccupancyMap map_of(const std::vector<std::string>& rows, const std::string& more = "") {
    auto map = read_occupancy(facts_of(yaml + more), picture(rows), "map.pgm", occupancy_height, {"s.lua", 3});
    INFO((map ? std::string() : describe(map.error())));
    REQUIRE(map.has_value());
    return *map;
}

std::string picture_error(std::string_view bytes) {
    const auto map = read_occupancy(facts_of(yaml), bytes, "map.pgm", occupancy_height, {});
    return map ? "no error" : describe(map.error());
}

}  // namespace

TEST_CASE("the YAML file of a map is read as ROS writes it", "[engine][map]") {
    const OccupancyFacts facts = facts_of(
        "# saved\nimage: \"rooms/a b.pgm\"  # beside it\nmode: trinary\nresolution: 0.050000\norigin: [-10, 2.5e-1, "
        "1.57]\nnegate: 1\noccupied_thresh: 0.8\nfree_thresh: 0.25\r\n\n");
    CHECK(facts.image == "rooms/a b.pgm");
    CHECK(facts.resolution == 0.05);
    CHECK(facts.origin.position == Point2D{-10, 0.25});
    CHECK(facts.origin.heading == 1.57);
    CHECK(facts.negate);
    CHECK(facts.threshold == 0.8);
    CHECK(facts_of(yaml).threshold == 0.65);
    CHECK_FALSE(facts_of(yaml).negate);
}

TEST_CASE("occupied pixels become as few boxes as their rows allow, where they are in the world", "[engine][map]") {
    const OccupancyMap map = map_of({"....",  //
                                     "##..",  //
                                     "##..",  //
                                     "?..#"});
    REQUIRE(map.boxes.size() == 2);
    CHECK(map.occupied == 5);
    CHECK(map.boxes[0].size == Point3D{0.1, 0.1, 0.1});
    CHECK(map.boxes[0].at.x == Approx(-1 + 0.05));
    CHECK(map.boxes[0].at.y == Approx(-2 + 0.1));
    CHECK(map.boxes[0].at.z == 0.05);  // on the floor
    CHECK(map.boxes[0].mass == 0);
    CHECK(map.boxes[0].place == Place{"s.lua", 3});
    CHECK(map.boxes[1].at.x == Approx(-1 + 0.175));
    CHECK(map.boxes[1].at.y == Approx(-2 + 0.025));
    CHECK(describe(map, "map.yaml") == "map.yaml: 2 boxes from 5 occupied pixels of 4 x 4");
}

TEST_CASE("a map's threshold, its inversion and its turn are kept", "[engine][map]") {
    CHECK(map_of({"#?."}, "occupied_thresh: 0.1\n").occupied == 2);
    CHECK(map_of({"#?."}, "negate: 1\n").occupied == 2);
    const OccupancyFacts turned =
        facts_of("image: m.pgm\nresolution: 0.1\norigin: [1, 1, " + std::to_string(M_PI / 2) + "]\n");
    const auto map = read_occupancy(turned, picture({"..#"}), "m.pgm", 0.3, {});
    REQUIRE(map.has_value());
    REQUIRE(map->boxes.size() == 1);
    CHECK(map->boxes[0].at.x == Approx(1 - 0.05).margin(1e-6));
    CHECK(map->boxes[0].at.y == Approx(1 + 0.25).margin(1e-6));
    CHECK(map->boxes[0].yaw == Approx(M_PI / 2).margin(1e-6));
    CHECK(map->boxes[0].size.z == 0.3);
    CHECK(map->boxes[0].at.z == 0.15);
}

TEST_CASE("every occupied pixel is covered once", "[engine][map]") {
    std::vector<std::string> rows(40, std::string(50, '.'));
    std::uint32_t random = 1;
    for (std::string& row : rows) {
        for (char& c : row) {
            random = random * 1664525 + 1013904223;
            if (random >> 30 != 0) c = '#';
        }
    }
    const OccupancyMap map = map_of(rows);
    double area = 0;
    for (const BoxSpec& box : map.boxes) area += box.size.x * box.size.y;
    CHECK(area == Approx(static_cast<double>(map.occupied) * 0.05 * 0.05));
    for (const BoxSpec& box : map.boxes) {
        const int column = static_cast<int>((box.at.x + 1) / 0.05), row = 39 - static_cast<int>((box.at.y + 2) / 0.05);
        const auto& line = rows[static_cast<std::size_t>(std::clamp(row, 0, 39))];
        CHECK(line[static_cast<std::size_t>(std::clamp(column, 0, 49))] == '#');
    }
}

TEST_CASE("an error in the YAML file of a map has the line and the expected value", "[engine][map]") {
    CHECK(facts_error("") == "map.yaml: is not a map of ROS: it has no 'image:'");
    CHECK(facts_error("image: m.pgm\n") == "map.yaml: is not a map of ROS: it has no 'resolution:'");
    CHECK(facts_error("image: m.pgm\nresolution: 0.1\n") == "map.yaml: is not a map of ROS: it has no 'origin:'");
    CHECK(facts_error("image: m.pgm\nresolution: wide\n") ==
          "map.yaml:2: 'resolution': expected the edge of a pixel in m, from 0.001 to 1000, got 'wide'");
    for (const std::string absurd : {"1e300", "1e-300", "1001", "-1", "inf"}) {
        CHECK(facts_error("image: m.pgm\nresolution: " + absurd + "\n") ==
              "map.yaml:2: 'resolution': expected the edge of a pixel in m, from 0.001 to 1000, got '" + absurd + "'");
    }
    CHECK(facts_error("image: m.pgm\norigin: [0, 1e300]\n") ==
          "map.yaml:2: 'origin': expected numbers up to 1000000, got '[0, 1e300]'");
    CHECK(facts_error("origin: 5\n") == "map.yaml:1: 'origin': expected [x, y, yaw], got '5'");
    CHECK(facts_error("origin: [1]\n") == "map.yaml:1: 'origin': expected [x, y, yaw], got '[1]'");
    CHECK(facts_error("origin: [1, 2, 3, 4]\n") == "map.yaml:1: 'origin': expected [x, y, yaw], got '[1, 2, 3, 4]'");
    CHECK(facts_error("negate: maybe\n") == "map.yaml:1: 'negate': expected 0 or 1, got 'maybe'");
    CHECK(facts_error("mode: grey\n") == "map.yaml:1: 'mode': expected trinary, scale or raw, got 'grey'");
    CHECK(facts_error("image: [a, b]\n") == "map.yaml:1: 'image': expected the name of a picture's file, got '[a, b]'");
    CHECK_THAT(facts_error("image: m.pgm\norigin: [0, 0\n"), Catch::Contains("is not YAML: "));
    CHECK(facts_error("image: \"\\\x01\"\n").find('\x01') ==
          std::string::npos);  // what YAML's reader quotes is visible
    CHECK(facts_error("occupied_thresh: 65\n") ==
          "map.yaml:1: 'occupied_thresh': expected a number from 0 to 1, got '65'");
}

TEST_CASE("a key within another mapping of a map's YAML file is ignored", "[engine][map]") {
    const OccupancyFacts facts = facts_of(yaml + "saved:\n  resolution: 0.1\n  negate: 1\n");
    CHECK(facts.resolution == 0.05);
    CHECK_FALSE(facts.negate);
    CHECK(facts_error("map:\n  image: m.pgm\nresolution: 0.1\norigin: [0, 0]\n") ==
          "map.yaml: is not a map of ROS: it has no 'image:'");
}

TEST_CASE("a map's YAML file may be written in any way of YAML", "[engine][map]") {
    for (const std::string text :
         {"{image: m.pgm, resolution: 0.05, origin: [-1, -2, 0], negate: False}",
          "\xef\xbb\xbfimage: m.pgm\r\nresolution: 0.05\r\norigin:\r\n- -1\r\n- -2\r\n- 0.0\r\n",
          "edge: &e 0.05\n'image': 'm.pgm'\n\"resolution\": *e\norigin: [\n  -1.0,\n  -2.0\n]\nnegate: no\n"}) {
        INFO(text);
        const OccupancyFacts facts = facts_of(text);
        CHECK(facts.image == "m.pgm");
        CHECK(facts.resolution == 0.05);
        CHECK(facts.origin.position == Point2D{-1, -2});
        CHECK_FALSE(facts.negate);
    }
    CHECK(facts_of(yaml + "negate: True\n").negate);
    CHECK(facts_of("image: 'room #2.pgm'\nresolution: 0.05\norigin: [0, 0, 0]\n").image == "room #2.pgm");
}

TEST_CASE("a raw map's pixels are parts of occupied in percent, and those above are not known", "[engine][map]") {
    const OccupancyFacts raw = facts_of(yaml + "mode: raw\n");
    const std::string pixels = std::string("P5\n5 1\n255\n") + '\0' + '\x41' + '\x42' + '\x64' + '\xff';
    const auto map = read_occupancy(raw, pixels, "m.pgm", occupancy_height, {});
    REQUIRE(map.has_value());
    CHECK(map->occupied == 2);  // 66 and 100
    CHECK(map_of({"#?."}, "mode: scale\n").occupied == 1);
}

TEST_CASE("a map's picture may be an ASCII PGM, and of any white", "[engine][map]") {
    const auto occupied = [](std::string_view bytes) {
        const auto map = read_occupancy(facts_of(yaml), bytes, "m.pgm", occupancy_height, {});
        INFO((map ? std::string() : describe(map.error())));
        REQUIRE(map.has_value());
        return map->occupied;
    };
    CHECK(occupied("P2\n# by hand\n3 1\n255\n0 205 254\n") == 1);
    CHECK(occupied("P2\n3 1\n15\n0 12 15\n") == 1);
    CHECK(occupied(std::string("P5\n3 1\n15\n") + '\0' + '\x0c' + '\x0f') == 1);
    CHECK(occupied(std::string("P5\n3 1\n65535\n") + std::string(2, '\0') + "\xcd\xcd\xfe\xfe") == 1);
}

TEST_CASE("an error in the picture of a map has the reason", "[engine][map]") {
    const std::string none = "OpenCV can't read its format (PNG, JPEG, BMP, TIFF, WebP, PPM and others are possible)";
    CHECK(picture_error("") == "map.pgm: is not a map: it is empty");
    for (const std::string bytes : {"P5\n1", "P5 # no end", "P5\n2 2\n255\nabc", "P7\n1 1\n255\n0"}) {
        INFO(bytes);
        CHECK(picture_error(bytes) == "map.pgm: is not a map: " + none);
    }
    CHECK(picture_error("P5\n9000000000000000000 9\n255\n").find("map.pgm: is not a map: ") == 0);
}

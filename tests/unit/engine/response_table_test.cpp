// From distance to value: exact at the points, never beyond the bounds.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "engine/world/robot_spec.hpp"
#include "tests/unit/file_text.hpp"

using namespace nezumi;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<ResponseTable::Point> mouse_points() {
    const auto points = read_csv_response(text_of_file("engine/robots/ir_table.csv"), "ir_table.csv");
    REQUIRE(points.has_value());
    return *points;
}

ResponseTable mouse_table() { return *ResponseTable::from_points(mouse_points(), 0.60, 0, 0, 4095); }

std::string table_error(std::vector<ResponseTable::Point> points, double range = 1, double minimum = 0,
                        double maximum = 10) {
    const auto made = ResponseTable::from_points(std::move(points), range, 0, minimum, maximum);
    return made ? "no error" : describe(made.error());
}

std::string csv_error(std::string_view text) {
    const auto points = read_csv_response(text, "table.csv");
    return points ? "no error" : describe(points.error());
}

}  // namespace

TEST_CASE("the mouse's table is met exactly at its 14 points", "[engine][response]") {
    const std::vector<std::pair<double, double>> expected{
        {0.01, 1394}, {0.02, 792}, {0.03, 525}, {0.04, 373}, {0.05, 299}, {0.06, 260}, {0.07, 222},
        {0.08, 181},  {0.09, 135}, {0.10, 100}, {0.15, 81},  {0.20, 36},  {0.25, 17},  {0.30, 16}};
    const ResponseTable table = mouse_table();
    for (const auto& [distance, value] : expected) CHECK(table(distance) == value);
}

TEST_CASE("the mouse's table falls all the way and stays within 0 and 4095", "[engine][response]") {
    const ResponseTable table = mouse_table();
    double before = infinity;
    for (int i = 0; i <= 8000; ++i) {
        const double value = table(i * 0.0001);
        CAPTURE(i, value, before);
        REQUIRE(value <= before);
        REQUIRE(value >= 0);
        REQUIRE(value <= 4095);
        before = value;
    }
}

TEST_CASE("nearer than its first point the mouse's table keeps rising to 4095", "[engine][response]") {
    const ResponseTable table = mouse_table();
    CHECK(table(0.009) > 1394);
    CHECK(table(0.005) > table(0.009));
    CHECK(table(0.005) == Approx(1394 * std::pow(0.5, std::log(792.0 / 1394.0) / std::log(2.0))));
    CHECK(table(0.003) > table(0.005));
    CHECK(table(0.001) == 4095);
    CHECK(table(0) == 4095);
    CHECK(table(-0.01) == 4095);
}

TEST_CASE("past its last point the mouse's table falls straight to 0 at 0.60 m", "[engine][response]") {
    const ResponseTable table = mouse_table();
    CHECK(table(0.45) == Approx(8));
    CHECK(table(0.599) > 0);
    CHECK(table(0.60) == 0);
    CHECK(table(0.61) == 0);
    CHECK(table(infinity) == 0);
    CHECK(table(std::numeric_limits<double>::quiet_NaN()) == 0);
}

TEST_CASE("a table that rises with the distance works the same", "[engine][response]") {
    const ResponseTable table = *ResponseTable::from_points({{0.1, 1}, {0.2, 2}}, 0.4, 5, 0, 10);
    CHECK(table(0) == 0);
    CHECK(table(0.05) == Approx(0.5));
    CHECK(table(0.15) == Approx(1.5));
    CHECK(table(0.3) == Approx(3.5));
    CHECK(table(0.4) == 5);
    CHECK(table(infinity) == 5);
}

TEST_CASE("where no power law fits, a table goes on straight before its first point", "[engine][response]") {
    const ResponseTable zero = *ResponseTable::from_points({{0.1, 0}, {0.2, 3}}, 0.4, 0, -2, 10);
    CHECK(zero(0.05) == Approx(-1.5));
    CHECK(zero(0) == -2);
    const ResponseTable flat = *ResponseTable::from_points({{0.1, 3}, {0.2, 3}}, 0.4, 0, 0, 10);
    CHECK(flat(0.05) == 3);
    const ResponseTable origin = *ResponseTable::from_points({{0, 3}, {0.2, 2}}, 0.4, 0, 0, 10);
    CHECK(origin(0) == 3);
    CHECK(origin(0.1) == Approx(2.5));
}

TEST_CASE("a sensor that sees less far than its table reaches sees nothing beyond its range", "[engine][response]") {
    const ResponseTable table = *ResponseTable::from_points({{0.1, 8}, {0.2, 4}, {0.3, 2}}, 0.25, 0, 0, 10);
    CHECK(table(0.25) == Approx(3));
    CHECK(table(0.26) == 0);
    const ResponseTable even = *ResponseTable::from_points({{0.1, 8}, {0.2, 4}}, 0.2, 0, 0, 10);
    CHECK(even(0.2) == 4);
    CHECK(even(0.21) == 0);
}

TEST_CASE("a response function's samples are met and joined by straight lines", "[engine][response]") {
    const ResponseTable table = ResponseTable::from_samples({10, 6, 4, 3, 2}, 0.4, -1);
    CHECK(table(-1) == 10);
    CHECK(table(0) == 10);
    CHECK(table(0.1) == Approx(6));
    CHECK(table(0.15) == Approx(5));
    CHECK(table(0.4) == 2);
    CHECK(table(0.41) == -1);
    CHECK(table(infinity) == -1);
    CHECK(table.clamp(100) == 10);
    CHECK(table.clamp(-100) == -1);
    CHECK(table.range() == 0.4);
    CHECK(table.nothing() == -1);
}

TEST_CASE("a response table refuses invalid points", "[engine][response]") {
    CHECK(table_error({}) == "a response table needs at least two points, got 0");
    CHECK(table_error({{0.1, 1}}) == "a response table needs at least two points, got 1");
    CHECK(table_error({{0.2, 1}, {0.1, 2}}) == "distances must ascend: 0.1 m comes after 0.2 m");
    CHECK(table_error({{0.1, 1}, {0.1, 2}}) == "distances must ascend: 0.1 m comes after 0.1 m");
    CHECK(table_error({{-0.1, 1}, {0.1, 2}}) == "point 1 (-0.1 m, 1) is not a distance and a finite value");
    CHECK(table_error({{0.1, 1}, {0.2, infinity}}) == "point 2 (0.2 m, inf) is not a distance and a finite value");
    CHECK(table_error({{0.1, 1}, {0.2, 2}}, 0) == "a range of 0 m is not a positive number");
    CHECK(table_error({{0.1, 1}, {0.2, 2}}, 1, 5, 4) == "the values' minimum 5 is above their maximum 4");
    CHECK(table_error({{0.1, 1}, {0.2, 2}}, 1, std::nan(""), 4) == "the values' minimum or maximum is not a number");
}

TEST_CASE("a response table's file names the line of a bad row", "[engine][response]") {
    CHECK(csv_error("distance_m,value\n0.1,5\n0.1,4\n") ==
          "table.csv:3: column 'distance_m': distances must ascend, got 0.1 after 0.1");
    CHECK(csv_error("distance_m,value\n-0.1,5\n") ==
          "table.csv:2: column 'distance_m': expected a number from 0 on, got '-0.1'");
    CHECK(
        csv_error("distance,value\n0.1,5\n") ==
        "table.csv:1: unknown column 'distance' (did you mean 'distance_m'?); expected a header row distance_m,value");
    CHECK(csv_error("distance_m,value\n0.1,5\n") == "table.csv: a response table needs at least two rows, got 1");
    CHECK(csv_error("distance_m,value\n0.1,-5\n0.2,x\n") == "table.csv:3: column 'value': expected a number, got 'x'");
}

TEST_CASE("a distance is found back from its value", "[engine][response]") {
    const auto table = ResponseTable::from_points({{0.01, 1000}, {0.1, 100}, {0.3, 10}}, 0.6, 0, 0, 4095);
    REQUIRE(table);
    for (const double distance : {0.01, 0.02, 0.1, 0.2, 0.3, 0.45})
        CHECK(distance_at(*table, (*table)(distance)) == Approx(distance).margin(1e-6));
    CHECK(distance_at(*table, 0) == 0.6);
    CHECK(distance_at(*table, -3) == 0.6);
    CHECK(distance_at(*table, 4095) < 0.01);
}

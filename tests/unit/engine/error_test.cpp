// What a person reads when something is wrong: the place, and the name they meant.
#include "engine/base/error.hpp"

#include <catch2/catch.hpp>

using namespace nezumi;

TEST_CASE("an error without a location is its message alone", "[engine][error]") {
    CHECK(describe({.message = "no such robot"}) == "no such robot");
    CHECK(describe({.message = "no such robot", .place = {.line = 3}}) == "no such robot");
}

TEST_CASE("an error shows as much of its location as is known", "[engine][error]") {
    CHECK(describe({"bad row", {"map.csv"}}) == "map.csv: bad row");
    CHECK(describe({"bad row", {"map.csv", 7}}) == "map.csv:7: bad row");
    CHECK(describe({"bad row", {"map.csv", 7, 12}}) == "map.csv:7:12: bad row");
}

TEST_CASE("a column without a line is not shown", "[engine][error]") {
    CHECK(describe({"bad row", {"map.csv", 0, 12}}) == "map.csv: bad row");
}

TEST_CASE("a failure becomes any Expected and keeps its message and location", "[engine][error]") {
    const Expected<int> number = failure("not a number", {"a.lua", 2});
    REQUIRE_FALSE(number.has_value());
    CHECK(number.error() == Error{"not a number", {"a.lua", 2}});
    const Expected<void> nothing = failure("not done");
    REQUIRE_FALSE(nothing.has_value());
    CHECK(nothing.error() == Error{"not done", {}});
}

TEST_CASE("the nearest name is one slip away", "[engine][error]") {
    const std::vector<std::string_view> names{"on_activated", "on_execute", "on_deactivated", "on_error"};
    CHECK(nearest("on_execute", names) == "on_execute");
    CHECK(nearest("on_exekute", names) == "on_execute");   // replaced
    CHECK(nearest("on_exeute", names) == "on_execute");    // left out
    CHECK(nearest("on_exxecute", names) == "on_execute");  // too many
    CHECK(nearest("on_exceute", names) == "on_execute");   // swapped
    CHECK(nearest("rum", {"rtm", "run"}) == "run");        // of two that are as near, the one that begins alike
    CHECK(nearest("ON_Execute", names) == "on_execute");   // case is not counted
    CHECK(nearest("on_activate", names) == "on_activated");
}

TEST_CASE("two swapped letters are one slip, not two", "[engine][error]") {
    CHECK(nearest("ni", {"in"}) == "in");
    CHECK(nearest("teh", {"the"}) == "the");
}

TEST_CASE("a name far from all others has no nearest", "[engine][error]") {
    CHECK(nearest("brightness", {"on_execute", "speed_x"}).empty());
    CHECK(nearest("xy", {"ab"}).empty());
    CHECK(nearest("speed", {}).empty());
    CHECK(nearest("", {"speed"}).empty());
}

TEST_CASE("a slip is at most a third of the name", "[engine][error]") {
    CHECK(nearest("abcdef", {"abcdxy"}) == "abcdxy");  // 2 of 6
    CHECK(nearest("abcde", {"abcxy"}).empty());        // 2 of 5
    CHECK(nearest("abcdef", {"abcxyz"}).empty());      // 3 of 6
}

TEST_CASE("there is no near name for one of which no character stays", "[engine][error]") {
    CHECK(nearest("z", {"x", "y"}).empty());
    CHECK(nearest("X", {"x", "y"}) == "x");
    CHECK(nearest("1", {"n"}).empty());
    CHECK(nearest("nn", {"m", "n"}) == "n");
}

TEST_CASE("a name that is part of another, or has another as its part, is near to it", "[engine][error]") {
    CHECK(nearest("on_exec", {"on_error", "on_execute"}) == "on_execute");
    CHECK(nearest("Velocity2D", {"TimedPose2D", "TimedVelocity2D"}) == "TimedVelocity2D");
    CHECK(nearest("velocity", {"target_velocity_in", "velocity_out"}) == "velocity_out");  // the least is left out
    CHECK(nearest("controller_left", {"left", "controller"}) == "controller");
    CHECK(nearest("in", {"ir_sensor_in"}).empty());                      // two letters are part of anything
    CHECK(nearest("speed_x", {"speed_x_max", "speed_y"}) == "speed_y");  // a slip is nearer
}

TEST_CASE("of several candidates the nearest wins, and the first of equals", "[engine][error]") {
    CHECK(nearest("speed_z", {"speed", "speed_x", "speed_r"}) == "speed_x");
    CHECK(nearest("speed_rr", {"speed_x", "speed_r"}) == "speed_r");
}

TEST_CASE("a suggestion reads as the end of a sentence, or is nothing", "[engine][error]") {
    CHECK("unknown type 'TimedShrt'" + did_you_mean("TimedShrt", {"TimedLong", "TimedShort"}) ==
          "unknown type 'TimedShrt' (did you mean 'TimedShort'?)");
    CHECK(did_you_mean("Joystick", {"TimedLong", "TimedShort"}).empty());
}

TEST_CASE("a name from outside is shown in one short line", "[engine][error]") {
    CHECK(shown("speed_x") == "speed_x");
    CHECK(shown(std::string_view("a\nb\0\x1b[1m", 8)) == "a\\x0ab\\x00\\x1b[1m");
    CHECK(shown("M\xC3\xA4use\t") == "M\xC3\xA4use\\x09");
    CHECK(shown("a\xE2\x80\xAE"
                "aul.") == "a\\u202eaul.");
    CHECK(shown(std::string(1000, 'x')) == std::string(60, 'x') + "...");
}

// Places of fields in the text of a Lua file.
#include "bindings/lua/files/file_source.hpp"

#include <catch2/catch.hpp>

#include "bindings/lua/files/file_value.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;

namespace {

// "line:column" of a field of the call of `word` in `line`.
std::string where(const FileSource& source, std::string_view word, int line, const FieldPath& path) {
    const Place place = source.find(word, {"f.lua", line}, path, {});
    return std::to_string(place.line) + ":" + std::to_string(place.column);
}

}  // namespace

TEST_CASE("a field is found in nested tables", "[lua][file_source]") {
    const FileSource source(R"(robot "m" {
  model = "x", -- model = "y"
  pose = { x = 1,
           ["y"] = 2, },
  [3] = 4,
}
robot("n", { model = [[
a { b = 1 }]], pose =
  { x = 1 } }))",
                            "f.lua");
    CHECK(where(source, "robot", 1, {"model"}) == "2:3");
    CHECK(where(source, "robot", 1, {"pose"}) == "3:3");
    CHECK(where(source, "robot", 1, {"pose", "x"}) == "3:12");
    CHECK(where(source, "robot", 1, {"pose", "y"}) == "4:13");
    CHECK(where(source, "robot", 7, {"model"}) == "7:14");
    CHECK(where(source, "robot", 7, {"pose", "x"}) == "9:5");
}

TEST_CASE("a field that the text does not contain has the location of the outer field", "[lua][file_source]") {
    const FileSource source("robot 'm' { pose = home }\nrobot('n', fields)", "f.lua");
    CHECK(where(source, "robot", 1, {"pose", "x"}) == "1:13");
    CHECK(where(source, "robot", 1, {"model"}) == "1:0");
    CHECK(where(source, "robot", 2, {"model"}) == "2:0");
    CHECK(where(source, "robot", 9, {"model"}) == "9:0");
    CHECK(where(source, "behavior", 1, {"pose"}) == "1:0");
    CHECK(source.find("robot", {"other.lua", 1}, {"pose"}, {}) == Place{"other.lua", 1});
}

TEST_CASE("elements are counted, and inner calls are separate calls", "[lua][file_source]") {
    const FileSource source(
        "arena {\n  box { at = { 1, 2 } },\n  wall { at = { 3, 4 } }, size = { 5,\n 6 },\n  { 7 }, }", "f.lua");
    CHECK(where(source, "arena", 1, {"[1]"}) == "2:3");
    CHECK(where(source, "arena", 1, {"[2]"}) == "3:3");
    CHECK(where(source, "arena", 1, {"[3]"}) == "5:3");
    CHECK(where(source, "arena", 1, {"[3]", "[1]"}) == "5:5");
    CHECK(where(source, "arena", 1, {"size", "[2]"}) == "4:2");
    CHECK(where(source, "box", 2, {"at", "[2]"}) == "2:19");
    CHECK(where(source, "wall", 3, {"at"}) == "3:10");
}

TEST_CASE("of several calls in a line, the one whose text fits the arguments is chosen", "[lua][file_source]") {
    const FileSource source(
        "b 'a' { n = 1, at = { 1, -2 } } b('c', { n = x, at = { 1, 2 } }) b('d' .. i, { n = 3, [k] = 4 })\n"
        "b { f() } b { 1, t = true } b { 1, 's', 0x10 }",
        "f.lua");
    const auto place = [&](int line, std::string name, FileTable table, const FieldPath& path) {
        const Value value{std::move(table)};
        const Place found = source.find("b", {"f.lua", line}, path, {std::move(name), &value});
        CHECK(found.line == line);
        return found.column;
    };
    const auto fields = [](double n, double y) {
        return FileTable{{}, {{"at", {FileTable{{{1.0}, {y}}, {}}}}, {"n", {n}}}};
    };
    CHECK(place(1, "a", fields(1, -2), {"n"}) == 9);
    CHECK(place(1, "a", fields(1, -2), {"at", "[2]"}) == 26);
    CHECK(place(1, "", fields(1, -2), {"n"}) == 9);
    CHECK(place(1, "c", fields(1, 2), {"n"}) == 42);
    CHECK(place(1, "c", fields(5, 2), {"at"}) == 49);
    CHECK(place(1, "", fields(1, 2), {"n"}) == 42);
    CHECK(place(1, "d1", FileTable{{}, {{"m", {4.0}}, {"n", {3.0}}}}, {"n"}) == 80);
    INFO("no text that could have given it, or more than one: the line alone");
    CHECK(place(1, "a", fields(2, -2), {"n"}) == 0);
    CHECK(place(1, "", FileTable{{}, {{"m", {5.0}}}}, {"n"}) == 0);
    CHECK(source.find("b", {"f.lua", 1}, {"n"}, {}).column == 0);
    CHECK(place(2, "", FileTable{{{1.0}}, {{"t", {true}}}}, {"t"}) == 18);
    CHECK(place(2, "", FileTable{{{1.0}}, {{"t", {false}}}}, {"t"}) == 0);
    CHECK(place(2, "", FileTable{{{1.0}, {std::string("s")}}, {}}, {"[1]"}) == 0);
    CHECK(place(2, "", FileTable{{{2.0}, {3.0}}, {}}, {"[1]"}) == 5);
}

TEST_CASE("an error of a field has its location even if its word is called several times in the line",
          "[lua][file_source]") {
    using namespace system_files;
    CHECK(system_error(
              "arena { box { at = { 1, 0 }, size = { 0.1, 0.1, 0.1 } }, box { at = { 2, 0 }, size = { 0.1, 0.1, -0.1 "
              "} } }") == "s.lua:1:98: box: field 'size[3]' expected a positive number, got -0.1");
    const std::string m = "{ model = 'raspimouse', limits = { speed = ";
    CHECK(system_error("robot 'a' " + m + "1 } } robot 'b' " + m + "-3 } }") ==
          "s.lua:1:105: robot 'b': field 'limits.speed' expected a positive number, got -3");
    CHECK(system_error("local n = -3 robot 'a' " + m + "1 } } robot 'b' " + m + "n } }") ==
          "s.lua:1:118: robot 'b': field 'limits.speed' expected a positive number, got -3");
    CHECK(system_error("local function v(i) return i end for i = 0, 1 do box { at = { i, 0 }, size = { v(i), 1, 1 } } "
                       "box { at = { i, 0 }, size = { v(i), 1, 1 } } end") ==
          "s.lua:1: box: field 'size[1]' expected a positive number, got 0");
    const SystemSpec spec = system_of(
        "behavior 'a' { script = 'robot_controller', config = { stop_d = 1 } } behavior 'c' { script = "
        "'robot_controller',\n config = {\n stop_d = 99 } }");
    CHECK(entry<BehaviorEntry>(spec, 0).places.at("config.stop_d").column == 56);
    CHECK(entry<BehaviorEntry>(spec, 1).places.at("config.stop_d").line == 3);
    CHECK(entry<BehaviorEntry>(spec, 1).places.at("config.stop_d").column == 2);
}

TEST_CASE("fields are found beside functions, conditions and methods", "[lua][file_source]") {
    const FileSource source(R"(s:robot("m", {
  response = function(d)
    if d > 1 then local t = { yaw = 1, 2 } end
    return t, 3
  end,
  yaw = cond and { a = 1 } or { b = (function() return 2 end)() },
  at = vec({ 1 }, 2), mass == 3, 4,
  last = 1 }))",
                            "f.lua");
    CHECK(where(source, "robot", 1, {"response"}) == "2:3");
    CHECK(where(source, "robot", 1, {"yaw"}) == "6:3");
    CHECK(where(source, "robot", 1, {"at"}) == "7:3");
    CHECK(where(source, "robot", 1, {"last"}) == "8:3");
    CHECK(where(source, "robot", 1, {"[2]"}) == "7:34");
}

TEST_CASE("find() in a text with syntax errors returns a valid location", "[lua][file_source]") {
    for (const char* text : {"", "{", "}", "a {", "a { b = ", "a { 'x", "a { [[", "--[[", "a(}", "a { ) } ]", "= = {",
                             "a { end }", "a.b:c'd'{e=1"}) {
        CHECK(FileSource(text, "f.lua").find("a", {"f.lua", 1}, {"b"}, {}).line == 1);
    }
    CHECK(to_text({"sensors", "front", "at", "[2]"}) == "sensors.front.at[2]");
}

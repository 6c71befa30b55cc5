// The library that a script gets: what is there, what is not, and what can't be done with it.
#include <algorithm>
#include <catch2/catch.hpp>

#include "bindings/lua/sandbox/missing_names.hpp"
#include "sandbox_support.hpp"

namespace nezumi {
namespace {

std::string sorted_names(Box& box, const std::string& table) {
    return box.run("local names = {} for name in pairs(" + table +
                   ") do names[#names + 1] = name end return table.concat(names, ' ')");
}

TEST_CASE("a script has the safe part of Lua's library and nothing else", "[lua][library]") {
    Box box;
    lua_pushglobaltable(box.lua());
    std::vector<std::string> globals;
    for (lua_pushnil(box.lua()); lua_next(box.lua(), 1) != 0; lua_pop(box.lua(), 1))
        globals.emplace_back(lua_tostring(box.lua(), 2));
    std::sort(globals.begin(), globals.end());
    CHECK(globals == std::vector<std::string>{"assert",   "coroutine", "error",  "getmetatable", "ipairs",   "math",
                                              "next",     "pairs",     "pcall",  "print",        "rawequal", "rawget",
                                              "rawlen",   "rawset",    "select", "setmetatable", "string",   "table",
                                              "tonumber", "tostring",  "type",   "utf8",         "xpcall"});
    CHECK(std::vector<std::string>(sandbox_names().begin(), sandbox_names().end()) == globals);
    CHECK(sorted_names(box, "string") ==
          "byte char find format gmatch gsub len lower match pack packsize rep reverse sub unpack upper");
    CHECK(sorted_names(box, "table") == "concat insert move pack remove sort unpack");
    INFO("the fields that a text is checked by are those that there are");
    REQUIRE(sandbox_globals().libraries.size() == 5);
    for (const KnownLibrary& library : sandbox_globals().libraries) {
        std::string fields;
        for (const std::string& field : library.fields) fields += (fields.empty() ? "" : " ") + field;
        CHECK(fields == sorted_names(box, library.name));
        for (const Instead& instead : missing_names()) {
            const bool is_field = instead.name.starts_with(library.name + ".");
            if (is_field)
                CHECK(
                    (" " + fields + " ").find(" " + std::string(instead.name.substr(library.name.size() + 1)) + " ") ==
                    std::string::npos);
        }
    }
    CHECK(sorted_names(box, "math") ==
          "abs acos asin atan ceil cos deg exp floor fmod huge log max maxinteger min mininteger modf pi rad random "
          "randomseed "
          "sin sqrt tan tointeger type ult");
    CHECK(sorted_names(box, "utf8") == "char charpattern codepoint codes len offset");
    CHECK(sorted_names(box, "coroutine") == "close create isyieldable resume running status wrap yield");
    CHECK(box.run("return utf8.charpattern == '[\\0-\\x7F\\xC2-\\xFD][\\x80-\\xBF]*', math.huge == 1 / 0, math.pi") ==
          "true true 3.1415926535898");
}

TEST_CASE("print writes lines to the log", "[lua][library]") {
    Box box;
    box.run(
        "print() print(1, 1.5, 'a\\0b', nil, true) print(setmetatable({}, { __tostring = function() return 'mine' end "
        "}))");
    REQUIRE(box.printed.size() == 3);
    CHECK(box.printed[0].empty());
    CHECK(box.printed[1] == std::string("1\t1.5\ta\0b\tnil\ttrue", 18));
    CHECK(box.printed[2] == "mine");
}

TEST_CASE("all tables of one print share a limit", "[lua][library]") {
    Box box;
    CHECK(box.run("local t = {} for i = 1, 90 do t[i] = ('x'):rep(1900) end print(t, t, t)").empty());
    REQUIRE(box.printed.size() == 1);
    CHECK(box.printed[0].size() < 100'000);
    CHECK(box.printed[0].ends_with("\t{...}\t{...}"));
}

TEST_CASE("the time for showing a table counts as time of the script", "[lua][library][wallclock][watchdog]") {
    Box box;
    const std::string outcome = box.run_for_a_moment(
        "print({ setmetatable({}, { __tostring = function() while true do end end }) }) return 'goes on'");
    CHECK(outcome.find("ran for more than 0.1 s") != std::string::npos);
    CHECK(box.over_budget);
}

TEST_CASE("no text shows an address", "[lua][library]") {
    Box box;
    CHECK(
        box.run("local t, f = {}, print return tostring(t), tostring(f), tostring(t), tostring(coroutine.create(f))") ==
        "table: 1 function: 2 table: 1 thread: 3");
    CHECK(box.run("local t = {} return ('%s %10s %-9s|'):format(t, t, t)") == "table: 4   table: 4 table: 4 |");
    CHECK(box.run("local t = {} return ('%p %12p %p %p %p%%'):format(t, t, 1, nil, 'x') ") ==
          "table: 5     table: 5 (null) (null) string: 6%");
    CHECK(box.run("return ('%p'):format('x') == ('%p'):format('x'), ('%p'):format({}) ~= ('%p'):format({})") ==
          "true true");
    CHECK(box.run("return tostring(setmetatable({}, { __name = 'Robot' }))") == "Robot: 9");
    CHECK(box.run("return tostring(setmetatable({}, { __name = {} }))") == "table: 10");
    CHECK(box.run("return tostring(setmetatable({}, { __tostring = function() return 1 end }))") == "1");
    CHECK(box.run("return tostring(setmetatable({}, { __tostring = function() return {} end }))") ==
          "box.lua:1: '__tostring' must return a string");
    CHECK(box.run("return tostring()") == "box.lua:1: bad argument #1 to 'tostring' (value expected)");
    const char* const text = GENERATE(
        as<const char*>{}, "error({})", "return {} .. ''", "return {} + 1", "return {} < {}", "return #nil",
        "return nil .. print", "return ('%d'):format({})", "return ('%q'):format({})",
        "return setmetatable({}, { __name = 'Robot' }) + 1", "return ('x'):rep(print)", "return math.floor({})",
        "local t = {} t[{}] = 1 for k in pairs(t) do end", "error(print)", "print(print, {}, coroutine.running())",
        "return select(2, pcall(error, print))", "return table.concat({ {} })", "return tonumber({})",
        "return next({}, {})", "return ('x'):gsub('x', function() return {} end)", "return string.pack('z', {})");
    CAPTURE(text);
    std::string shown = box.run(text);
    for (const std::string& line : box.printed) shown += line;
    CHECK(shown.find("0x") == std::string::npos);
}

TEST_CASE("loops in C functions over a table with a false length end with the time limit", "[lua][watchdog]") {
    const std::string lying =
        "local t = setmetatable({}, { __len = function() return 1 << 23 end, __index = function() return 'x' end, "
        "__newindex = function() end }) ";
    const char* const text = GENERATE(as<const char*>{}, "table.insert(t, 1, 2)", "table.remove(t, 1)",
                                      "table.sort(t, function() return true end)", "table.concat(t)",
                                      "table.move(t, 1, 1 << 23, 2)", "for _ in ipairs(t) do end");
    Box box;
    CHECK(box.run_for_a_moment(lying + "while true do pcall(function() " + text + " end) end")
              .find("ran for more than 0.1 s") != std::string::npos);
}

TEST_CASE("random numbers follow the state's seed", "[lua][library]") {
    const char* const text =
        "return math.random(1000000), math.random(1000000), math.random() < 1, math.random(0) ~= 0";
    StateOptions options;
    options.seed = 7;
    Box a(options);
    Box b(options);
    options.seed = 8;
    Box c(options);
    const std::string first = a.run(text);
    CHECK(b.run(text) == first);
    CHECK(c.run(text) != first);
    CHECK(a.run(text) != first);
    a.state->seed_random(7);
    CHECK(a.run(text) == first);
    CHECK(a.run("math.randomseed() " + std::string(text)) == first);
    CHECK(a.run("math.randomseed(7) return math.random(1 << 30) == math.random(1 << 30)") == "false");
    CHECK(a.run("math.randomseed(1.5) local x = math.random() math.randomseed(1.5) return x == math.random(), "
                "math.randomseed(3, 4)") == "true 3 4");
    CHECK(a.run("for i = 1, 10000 do local x = math.random(3) assert(x >= 1 and x <= 3) local y = math.random(-5, 5) "
                "assert(y >= -5 and y <= 5) "
                "local z = math.random() assert(z >= 0 and z < 1) end return 'in bounds'") == "in bounds");
    CHECK(a.run("return math.type(math.random(math.mininteger, math.maxinteger)), math.random(5, 5)") == "integer 5");
    CHECK(a.run("return math.random(0.5)") ==
          "box.lua:1: bad argument #1 to 'random' (number has no integer representation)");
    CHECK(a.run("return math.random(2, 1)") == "box.lua:1: bad argument #2 to 'random' (interval is empty)");
    CHECK(a.run("return math.random(-1)") == "box.lua:1: bad argument #1 to 'random' (interval is empty)");
    CHECK(a.run("return math.random(1, 2, 3)") == "box.lua:1: wrong number of arguments");
    CHECK(a.run("local seen = {} for i = 1, 1000 do seen[math.random(4)] = true end return #seen") == "4");
}

TEST_CASE("the generator is xoshiro256**, seeded through splitmix64", "[lua][library]") {
    Random random(0);
    CHECK(random.next() == 11091344671253066420u);
    Random bounded(3);
    for (int i = 0; i < 1000; ++i) CHECK(bounded.next_up_to(5) <= 5);
    CHECK(bounded.next_up_to(0) == 0);
}

}  // namespace
}  // namespace nezumi

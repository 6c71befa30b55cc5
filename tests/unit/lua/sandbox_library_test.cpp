// The library that a script gets: what is there, what is not, and what can't be done with it.
#include <algorithm>
#include <catch2/catch.hpp>

#include "bindings/lua/sandbox/missing_names.hpp"
#include "machine_speed.hpp"
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

TEST_CASE("print gives lines to the log", "[lua][library]") {
    Box box;
    box.run(
        "print() print(1, 1.5, 'a\\0b', nil, true) print(setmetatable({}, { __tostring = function() return 'mine' end "
        "}))");
    REQUIRE(box.printed.size() == 3);
    CHECK(box.printed[0].empty());
    CHECK(box.printed[1] == std::string("1\t1.5\ta\0b\tnil\ttrue", 18));
    CHECK(box.printed[2] == "mine");
}

TEST_CASE("print shows tables as the console does", "[lua][library]") {
    Box box;
    CHECK(box.run("print({ 1, 2.5, 'x', b = { c = true } }, 'text', {})").empty());
    CHECK(box.run("local t = { 1 } t.me = t print(t)").empty());
    CHECK(box.run("print({ { { { { { { 7 } } } } } } })").empty());
    CHECK(box.run("local t = {} for i = 1, 200 do t[i] = 0 end print(t)").empty());
    CHECK(box.run("print(setmetatable({ 1 }, { __name = 'Robot' }), setmetatable({}, { __tostring = function() return "
                  "'mine' end }))")
              .empty());
    CHECK(box.run("print(('x'):rep(5000), tostring({}))").empty());
    REQUIRE(box.printed.size() == 6);
    CHECK(box.printed[0] == "{ 1, 2.5, \"x\", b = { c = true } }\ttext\t{}");
    CHECK(box.printed[1] == "{ 1, me = <cycle> }");
    CHECK(box.printed[2] == "{ { { { { { {...} } } } } } }");
    CHECK(std::count(box.printed[3].begin(), box.printed[3].end(), '0') == 100);
    CHECK(box.printed[3].ends_with("  ...\n}"));
    CHECK(box.printed[4] == "{ 1 }\tmine");
    CHECK(box.printed[5] == std::string(5000, 'x') + "\ttable: 1");
}

TEST_CASE("what all tables of one print may take is shared", "[lua][library]") {
    Box box;
    CHECK(box.run("local t = {} for i = 1, 90 do t[i] = ('x'):rep(1900) end print(t, t, t)").empty());
    REQUIRE(box.printed.size() == 1);
    CHECK(box.printed[0].size() < 100'000);
    CHECK(box.printed[0].ends_with("\t{...}\t{...}"));
}

TEST_CASE("a table that can't be shown costs its text and no more", "[lua][library]") {
    Box box;
    CHECK(box.run("print({ [{}] = 1 }) return 'goes on'") == "goes on");
    CHECK(box.run("print({ setmetatable({}, { __tostring = function() error('no', 0) end }) }) return 'goes on'") ==
          "goes on");
    REQUIRE(box.printed.size() == 2);
    CHECK(box.printed[0].find("<can't be shown: a table with a table or function as a key") == 0);
    CHECK(box.printed[1] == "<can't be shown: no>");
}

TEST_CASE("showing a table takes of the time of the script that prints it", "[lua][library][wallclock][watchdog]") {
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

TEST_CASE("counts beyond sense are refused at once", "[lua][library]") {
    Box box;
    const std::int64_t began = thread_time();
    CHECK(box.run("return string.rep('x', 1 << 60)") == "box.lua:1: resulting string too large");
    CHECK(box.run("return string.rep('x', 1 << 40, 'y')") == "box.lua:1: resulting string too large");
    CHECK(box.run("return string.rep('', 1 << 60)") == "box.lua:1: resulting string too large");
    CHECK(box.run("return string.rep('', 1 << 60, '')") == "box.lua:1: resulting string too large");
    CHECK(box.run("return string.rep('', 1000) == ''") == "true");
    CHECK(box.run("return string.rep('', 1 << 60, 'x')") == "box.lua:1: resulting string too large");
    CHECK(box.run("return string.rep('x', -1), ('x'):rep(math.mininteger), ('ab'):rep(3, ', '), ('x'):rep(1, 'yyy')") ==
          "  ab, ab, ab x");
    CHECK(box.run("return table.move({}, 1, 1 << 60, 2)") ==
          "box.lua:1: bad argument #3 to 'move' (too many elements to move)");
    CHECK(box.run("return table.move({}, math.mininteger, math.maxinteger, 2)") ==
          "box.lua:1: bad argument #3 to 'move' (too many elements to move)");
    CHECK(box.run("return table.move({}, 1, 3, math.maxinteger)") ==
          "box.lua:1: bad argument #4 to 'move' (destination wrap around)");
    CHECK(box.run("return table.concat({}, '', 1, 1 << 60)") ==
          "box.lua:1: bad argument #1 to 'concat' (too many elements to concatenate)");
    CHECK(box.run("return table.unpack({}, 1, 1 << 60)") == "box.lua:1: too many results to unpack");
    CHECK(box.run("return table.unpack({}, math.mininteger, math.maxinteger)") ==
          "box.lua:1: too many results to unpack");
    CHECK(box.run("return table.unpack({}, 1, 1e7)") == "box.lua:1: too many results to unpack");
    CHECK(box.run("return select('#', table.unpack({}, 1, 200000))") == "200000");
    const std::string lying = "local t = setmetatable({}, { __len = function() return 1 << 60 end }) ";
    CHECK(box.run(lying + "table.insert(t, 1, 2)") ==
          "box.lua:1: bad argument #2 to 'insert' (too many elements to move)");
    CHECK(box.run(lying + "table.remove(t, 1)") ==
          "box.lua:1: bad argument #2 to 'remove' (too many elements to move)");
    CHECK(box.run(lying + "table.sort(t)") == "box.lua:1: bad argument #1 to 'sort' (array too big)");
    CHECK(box.run(lying + "table.concat(t)") ==
          "box.lua:1: bad argument #1 to 'concat' (too many elements to concatenate)");
    CHECK(box.run(lying + "table.unpack(t)") == "box.lua:1: too many results to unpack");
    CHECK(box.run("table.sort(setmetatable({}, { __len = function() return 1 << 24 end }))") ==
          "box.lua:1: not enough memory: the script reached its limit of 64 MB");
    CHECK(box.run("table.insert(setmetatable({}, { __len = function() return 'x' end }), 1)") ==
          "box.lua:1: object length is not an integer");
    CHECK(
        box.run("table.insert(setmetatable({}, { __len = function() return math.maxinteger end }), 1) return 'done'") ==
        "done");
    CHECK(box.run("return #string.pack((' '):rep(10000))") == "0");  // as long as it may be
    CHECK(box.run("return string.packsize((' '):rep(10000))") == "0");
    for (const std::string call :
         {"pack((' '):rep(10001))", "packsize((' '):rep(10001))", "unpack((' '):rep(10001), '')"})
        CHECK(box.run("return string." + call).ends_with("(format too long)"));
    CHECK(box.run("return string.pack((' '):rep(20000))") == "box.lua:1: bad argument #1 to 'pack' (format too long)");
    CHECK(box.run("return string.unpack((' '):rep(20000), '')") ==
          "box.lua:1: bad argument #1 to 'unpack' (format too long)");
    CHECK(box.run("return select('#', ('x'):rep(1e7):byte(1, -1))") ==
          "box.lua:1: stack overflow (string slice too long)");
    CHECK(static_cast<double>(thread_time() - began) * 1e-9 < slowness());
}

TEST_CASE("loops in C over a lying table end by their time", "[lua][watchdog]") {
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

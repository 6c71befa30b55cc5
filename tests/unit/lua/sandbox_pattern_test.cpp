// The pattern functions against Lua's own, and against patterns that would not end.
#include <catch2/catch.hpp>
#include <random>

#include "engine/base/sanitizers.hpp"
#include "machine_speed.hpp"
#include "sandbox_support.hpp"

namespace nezumi {
namespace {

// Everything that the four functions give for a subject, a pattern and a replacement, errors included.
const char* const driver = R"(
return function(s, p, r)
  local out = {}
  local function add(...)
    for i = 1, select("#", ...) do out[#out + 1] = tostring((select(i, ...))) end
    out[#out + 1] = ";"
  end
  add(pcall(string.find, s, p))
  add(pcall(string.find, s, p, 3))
  add(pcall(string.match, s, p))
  add(pcall(string.match, s, p, -2))
  add(pcall(string.gsub, s, p, r))
  add(pcall(string.gsub, s, p, "<%0>", 2))
  add(pcall(string.gsub, s, p, { a = "A", ["1"] = false, b = 7 }))
  add(pcall(string.gsub, s, p, function(...) if select("#", ...) > 1 then return (...) end end))
  add(pcall(function()
    local n = 0
    for a, b in string.gmatch(s, p, #r) do
      n = n + 1
      out[#out + 1] = tostring(a) .. ":" .. tostring(b)
      if n > 50 then break end
    end
  end))
  return table.concat(out, "|")
end)";

std::string call_driver(lua_State* lua, const std::string& s, const std::string& p, const std::string& r, bool plain) {
    lua_pushvalue(lua, 1);
    for (const std::string* text : {&s, &p, &r}) lua_pushlstring(lua, text->data(), text->size());
    if (plain) {
        REQUIRE(lua_pcall(lua, 3, 1, 0) == LUA_OK);
    } else {
        REQUIRE(protected_call(lua, 3, 1, Budget{10.0}));
    }
    std::size_t length = 0;
    const char* text = lua_tolstring(lua, -1, &length);
    std::string result(text, length);
    lua_pop(lua, 1);
    return result;
}

TEST_CASE("patterns give the same results and errors as Lua's own functions", "[lua][pattern]") {
    Box box;
    load_chunk(box.lua(), compile(driver, "driver").value());
    REQUIRE(protected_call(box.lua(), 0, 1, paced_budget));
    const std::unique_ptr<lua_State, void (*)(lua_State*)> stock(luaL_newstate(), lua_close);
    luaL_openlibs(stock.get());
    REQUIRE(luaL_loadbufferx(stock.get(), driver, std::string_view(driver).size(), "@driver", "t") == LUA_OK);
    lua_call(stock.get(), 0, 1);

    const std::vector<std::string> items = {
        "a",    "b",      "1",      ".",    "%a",   "%d",    "%s",  "%W",   "%x",    "%u",    "%p",
        "%c",   "%g",     "%l",     "[ab]", "[^a]", "[a-c]", "[]]", "[^]]", "[%a-]", "[a-]",  "%b()",
        "%baa", "%f[%w]", "%f[^a]", "%1",   "%2",   "(",     ")",   "()",   "(a)",   "(.-)",  "(.*)",
        "*",    "+",      "-",      "?",    "^",    "$",     "%",   "[",    "]",     "%%",    "%.",
        "%z",   "%0",     "%f",     "%b",   "[%",   "[a%]",  " ",   "(()",  "[--a]", "[a-%d]"};
    const std::vector<std::string> replacements = {"", "x", "%0", "%1", "<%1%2>", "%%", "%", "%x", "%9", "a%0b%1"};
    const std::string alphabet("ab1 (){}[]%-.A\t\0\xe9", 18);
    std::mt19937 random(20240607);
    const auto draw = [&random](std::size_t below) { return static_cast<std::size_t>(random() % below); };
#ifdef NEZUMI_THREAD_SANITIZER
    constexpr int rounds = 2'000;  // it does not see the jumps of the system's Lua, and each is slower than the last
#else
    constexpr int rounds = 40'000;
#endif
    int errors = 0;
    int matches = 0;
    for (int round = 0; round < rounds; ++round) {
        std::string subject;
        for (std::size_t n = draw(12); n > 0; --n) subject += alphabet[draw(draw(3) == 0 ? alphabet.size() : 4)];
        std::string pattern;
        for (std::size_t n = draw(7); n > 0; --n) pattern += items[draw(items.size())];
        const std::string& replacement = replacements[draw(replacements.size())];
        const std::string expected = call_driver(stock.get(), subject, pattern, replacement, true);
        CAPTURE(subject, pattern, replacement);
        REQUIRE(call_driver(box.lua(), subject, pattern, replacement, false) == expected);
        if (expected.substr(0, 5) == "false") ++errors;
        if (expected.substr(0, 5) == "true|" && expected.substr(5, 3) != "nil") ++matches;
    }
    CHECK(errors > rounds / 40);
    CHECK(matches > rounds / 40);
}

TEST_CASE("a pattern that needs too many steps is an error in a short time", "[lua][pattern][watchdog]") {
    const char* const text =
        GENERATE(as<const char*>{}, "return ('a'):rep(32):find(('a?'):rep(32) .. ('a'):rep(32))",
                 "return ('a'):rep(3000):find('.-.-.-.-b')", "return ('a'):rep(3000):match('.*.*.*.*b')",
                 "return ('a'):rep(3000):gsub('.-.-.-.-b', '')", "for _ in ('a'):rep(3000):gmatch('.-.-.-.-b') do end",
                 "return ('a'):rep(100000):find('.-b')", "return ('('):rep(100000):find('%b()')",
                 "return ('x'):rep(1000000):find(('['):rep(1) .. ('ab'):rep(100000) .. ']*y')",
                 "return ('a'):rep(50000):find('(.*)%1b')",
                 "local s, p = ('a'):rep(3000), '.-.-b' for i = 1, 1000 do s:find(p) end");
    CAPTURE(text);
    Box box;
    const std::int64_t began = thread_time();
    CHECK(box.run(text, Budget{2.0}) == "box.lua:1: pattern too complex: it takes too many steps");
    CHECK(static_cast<double>(thread_time() - began) * 1e-9 < slowness());
    CHECK(box.run_for_a_moment(std::string("while true do pcall(function() ") + text + " end) end")
              .find("ran for more than 0.1 s") != std::string::npos);
}

}  // namespace
}  // namespace nezumi

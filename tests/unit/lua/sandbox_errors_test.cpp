// What a script's error looks like from outside, and what it may use of memory.
#include <catch2/catch.hpp>

#include <set>

#include "sandbox_support.hpp"

namespace nezumi {
namespace {

TEST_CASE("an error names the script's line", "[lua][call]") {
    Box box;
    CHECK(box.run("\n\nerror('stop')") == "box.lua:3: stop");
    CHECK(box.run("local function f() error('stop', 2) end\n\nf()") == "box.lua:3: stop");
    CHECK(box.run("\nerror('no place', 0)") == "box.lua:2: no place");
    CHECK(box.run("\nlocal t\nt.x = 1") == "box.lua:3: attempt to index a nil value (local 't')");
    CHECK(box.run("\nstring.rep()") == "box.lua:2: bad argument #1 to 'rep' (string expected, got no value)");
    CHECK(box.run("\nreturn ('x'):rep({})") == "box.lua:2: bad argument #1 to 'rep' (number expected, got table)");
    for (const char* call :
         {"pcall(string.rep)", "xpcall(string.rep, tostring)", "coroutine.resume(coroutine.create(string.rep))"}) {
        INFO(call);
        CHECK(box.run("error((select(2, " + std::string(call) + ")), 0)") ==
              "box.lua:1: bad argument #1 to 'string.rep' (string expected, got no value)");
    }
    CHECK(box.run("assert(false)") == "box.lua:1: assertion failed!");
    CHECK(box.run("assert(nil, 'because')") == "box.lua:1: because");
    CHECK(box.run("coroutine.wrap(function()\nerror('inside') end)()") == "box.lua:2: inside");
    CHECK(box.run("table.sort({ 2, 1 }, function()\nerror('inside') end)") == "box.lua:2: inside");
    CHECK(lua_gettop(box.lua()) == 0);
    CHECK_FALSE(box.over_budget);
}

TEST_CASE("an error has a location and a message", "[lua][call]") {
    Box box;
    load_chunk(box.lua(), compile("\nerror('stop: 12: x')", "folder/a.lua").value());
    const auto called = protected_call(box.lua(), 0, 0, paced_budget);
    REQUIRE_FALSE(called);
    CHECK(called.error().message == "stop: 12: x");
    CHECK(called.error().place == Place{"folder/a.lua", 2, 0});
}

TEST_CASE("the message of a syntax error is one printable line for every token", "[lua][call]") {
    const auto error = [](const std::string& text) { return describe(compile(text, "a.lua").error()); };
    CHECK(error("x = 'a' 'b\\nc\\27'") == "a.lua:1: unexpected symbol near ''b\\x0ac\\x1b''");
    CHECK(error("x = \"\xC2\x85\n") == "a.lua:1: unfinished string near '\"\\x85'");
    CHECK(error("x = 'a' '" + std::string(5000, 'b') + "'") ==
          "a.lua:1: unexpected symbol near ''" + std::string(59, 'b') + "...'");
}

TEST_CASE("an error's location has the full file name, even a long one", "[lua][call]") {
    const std::string name = std::string(100, 'd') + "/a.lua";
    Box box;
    load_chunk(box.lua(), compile("\nlocal x = nil + 1", name).value());
    const auto called = protected_call(box.lua(), 0, 0, paced_budget);
    CHECK(called.error().place == Place{name, 2, 0});
    CHECK(called.error().message == "attempt to perform arithmetic on a nil value");
    CHECK(compile("\nlocal x = = 1", name).error().place == Place{name, 2, 0});
    CHECK(compile("\nlocal x = = 1", name).error().message == "unexpected symbol near '='");
}

TEST_CASE("a hint is added to an error that fits", "[lua][call]") {
    Box box;
    box.state->set_hint([](const Error& error) -> std::string {
        return error.place.line == 1 && error.message.find("upvalue") != std::string::npos ? " (a hint)" : "";
    });
    CHECK(box.run("local u local function f() return u.x end f()") ==
          "box.lua:1: attempt to index a nil value (upvalue 'u') (a hint)");
    CHECK(box.run("local l return l.x") == "box.lua:1: attempt to index a nil value (local 'l')");
}

TEST_CASE("deep recursion through C functions is an error", "[lua][call]") {
    Box box;
    const char* const text = GENERATE(
        as<const char*>{},
        "local t = setmetatable({}, {}) getmetatable(t).__index = function(t, k) return t[k] end return t.x",
        "local t = setmetatable({}, {}) getmetatable(t).__newindex = function(t, k, v) t[k] = v end t.x = 1",
        "local t = setmetatable({}, {}) getmetatable(t).__concat = function(a, b) return a .. b end return t .. t",
        "local t = setmetatable({}, {}) getmetatable(t).__add = function(a, b) return a + b end return t + t",
        "local t = setmetatable({}, {}) getmetatable(t).__eq = function(a, b) return a == {} end return t == {}",
        "local t = setmetatable({}, {}) getmetatable(t).__lt = function(a, b) return a < b end return t < t",
        "local t = setmetatable({}, {}) getmetatable(t).__len = function(a) return #a end return #t",
        "local t = setmetatable({}, {}) getmetatable(t).__call = function(a) return 1 + a() end return t()",
        "local t = setmetatable({}, { __tostring = function(t) return tostring(t) end }) return tostring(t)",
        "local t = setmetatable({}, { __tostring = function(t) return ('%s'):format(t) end }) print(t)",
        "local t = setmetatable({}, { __pairs = function(t) return pairs(t) end }) pairs(t)",
        "local function f(s) return (s:gsub('.', f)) end f('x')",
        "local t = setmetatable({}, {}) getmetatable(t).__index = function(_, k) return ('x'):gsub('x', t) end "
        "('x'):gsub('x', t)",
        "local function f() table.sort({ 1, 2, 3 }, f) end f()", "local function f() coroutine.wrap(f)() end f()",
        "local function f() for _ in coroutine.wrap(f) do end end f()",
        "local t = setmetatable({}, {}) getmetatable(t).__lt = function() table.sort { t, t } end table.sort { t, t }",
        "local t = setmetatable({}, {}) getmetatable(t).__len = function() table.insert(t, 1) end table.insert(t, 1)",
        "local t = setmetatable({}, {}) getmetatable(t).__index = function() return table.concat(t, '', 1, 1) end "
        "table.concat(t, '', 1, 1)",
        "local t = setmetatable({}, {}) getmetatable(t).__index = function() return table.unpack(t, 1, 1) end "
        "table.unpack(t, 1, 1)",
        "local t = setmetatable({}, {}) getmetatable(t).__close = function() local x <close> = t end local x <close> = "
        "t",
        "local function f() local c = coroutine.create(function() local x <close> = setmetatable({}, { __close = f }) "
        "coroutine.yield() end) coroutine.resume(c) local ok, e = coroutine.close(c) if not ok then error(e, 0) end "
        "end f()");
    CAPTURE(text);
    const std::string outcome = box.run(text, Budget{2.0});
    CHECK((outcome.find("stack overflow") != std::string::npos ||
           outcome.find("error in error handling") != std::string::npos));
    CHECK(box.run("return 'the state lives on'") == "the state lives on");
}

TEST_CASE("deep recursion that a script catches repeatedly ends with its time", "[lua][watchdog]") {
    const char* const text = GENERATE(
        as<const char*>{}, "local function f() while true do pcall(f) end end f()",
        "local function f() xpcall(f, f) f() end while true do pcall(f) end",
        "local function f() local c = coroutine.create(f) coroutine.resume(c) f() end while true do pcall(f) end",
        "local function f() xpcall(function() local x <close> = setmetatable({}, { __close = f }) f() end, f) end "
        "while true do pcall(f) end");
    Box box;
    CHECK(box.run_for_a_moment(text).find("ran for more than 0.1 s") != std::string::npos);
    CHECK(box.run("return 'the state lives on'") == "the state lives on");
}

TEST_CASE("the memory limit is exact", "[lua][memory]") {
    StateOptions options;
    options.memory_limit = 1 << 20;
    Box box(options);
    CHECK(box.run("return #('x'):rep(400000)") == "400000");
    CHECK(box.run("local t = {} while true do t[#t + 1] = {} end") ==
          "box.lua:1: not enough memory: the script reached its limit of 1 MB");
    CHECK(box.state->memory() < 20'000);  // and nothing of it stays
    CHECK(box.run("\nlocal s = 'x' while true do s = s .. s end") ==
          "box.lua:2: not enough memory: the script reached its limit of 1 MB");
    CHECK(box.run("local s = 'x' return pcall(function() while true do s = s .. s end end)") ==
          "false not enough memory");
    CHECK(box.run("return 'the state lives on'") == "the state lives on");
}

// Lua 5.4.7 keeps offsets in place of its stack's pointers while it asks for a larger stack.
TEST_CASE("a memory error while the stack grows has its line", "[lua][memory]") {
    const char* const text =
        "local function down(n) local a, b, c, d, e, f = n, n, n, n, n, n\n"
        "return 1 + down(n + 1) end\n"
        "down(1)";
    Box box;
    const std::size_t before = box.state->memory();
    for (std::size_t more = 1000; more < 300'000; more += 977) {
        CAPTURE(more);
        box.state->set_memory_limit(before + more);
        load_chunk(box.lua(), compile(text, "box.lua").value());
        const auto called = protected_call(box.lua(), 0, 0, Budget{10.0});
        REQUIRE_FALSE(called);
        CHECK(called.error().message.find("not enough memory: the script reached its limit of ") == 0);
        CHECK(called.error().place.line >= 1);
        CHECK(called.error().place.line <= 3);
        lua_settop(box.lua(), 0);
        box.state->set_memory_limit(1 << 20);
        CHECK(box.run("return 'the state lives on'") == "the state lives on");
    }
}

TEST_CASE("an error value that is a number is reported even if there is no memory for its text", "[lua][memory]") {
    Box box;
    REQUIRE(box.run("function raise() error(0.1234567890123) end") == "");
    std::set<std::string> said;
    for (std::size_t more = 0; more < 600; more += 8) {
        lua_getglobal(box.lua(), "raise");
        lua_gc(box.lua(), LUA_GCCOLLECT);
        box.state->set_memory_limit(box.state->memory() + more);
        const auto called = protected_call(box.lua(), 0, 0, Budget{10.0});
        REQUIRE_FALSE(called);
        said.insert(called.error().message.substr(0, 17));
        box.state->set_memory_limit(1 << 20);
    }
    CHECK(said == std::set<std::string>{"0.1234567890123", "not enough memory"});
}

TEST_CASE("released memory is no longer counted", "[lua][memory]") {
    Box box;
    lua_gc(box.lua(), LUA_GCCOLLECT);
    const std::size_t before = box.state->memory();
    CHECK(before < 16'000);
    CHECK(box.run("local t = {} for i = 1, 10000 do t[i] = { i } end return #t") == "10000");
    lua_settop(box.lua(), 0);
    lua_gc(box.lua(), LUA_GCCOLLECT);
    lua_gc(box.lua(), LUA_GCCOLLECT);
    CHECK(box.state->memory() < before + 1000);
    CHECK(box.state->memory() == static_cast<std::size_t>(lua_gc(box.lua(), LUA_GCCOUNT)) * 1024 +
                                     static_cast<std::size_t>(lua_gc(box.lua(), LUA_GCCOUNTB)));
}

TEST_CASE("a state with too little memory is refused", "[lua][memory]") {
    StateOptions options;
    for (options.memory_limit = 1000; options.memory_limit < 20'000; options.memory_limit += 97) {
        const auto state = create_sandbox(options);
        if (state) break;
        CHECK(state.error().message.find("not enough memory") == 0);
    }
    CHECK(options.memory_limit > 5000);
    CHECK(options.memory_limit < 20'000);
}

TEST_CASE("a state stays usable after a memory error at any point", "[lua][memory]") {
    const char* const text =
        "local t = {} for i = 1, 20 do t['k' .. i] = { i, tostring({}) } end for k, v in pairs(t) do t[k] = v[1] .. k "
        "end "
        "table.sort({ 3, 1, 2 }, function(a, b) return a < b end) local s = ('a,b,c'):gsub('%w', { a = 'x' }) "
        "for w in s:gmatch('%w') do t[#t + 1] = w end local c = coroutine.wrap(function() "
        "coroutine.yield(('%p'):format(t)) end) "
        "c() c() print(t, next(t), table.unpack(t)) return pcall(error, { s })";
    Box plenty;
    CHECK(plenty.run(text) == "false table");
    std::size_t failures = 0;
    for (std::size_t more = 0; more < 20'000; more += 61) {
        Box box;
        const Chunk chunk = compile(text, "box.lua").value();
        box.state->set_memory_limit(box.state->memory() + more);
        if (const auto loaded = load_chunk(box.lua(), chunk)) {
            const std::string outcome = box.call();
            if (outcome != "false table" && outcome != "false string") {
                CHECK(outcome.find("not enough memory") != std::string::npos);
                ++failures;
            }
        } else {
            CHECK(loaded.error().message.find("not enough memory") == 0);
        }
        lua_settop(box.lua(), 0);
        box.state->set_memory_limit(1 << 20);
        CHECK(box.run("return 'the state lives on'") == "the state lives on");
    }
    CHECK(failures > 10);
}

}  // namespace
}  // namespace nezumi

// From text to a chunk, and globals that can't be invented at run time.
#include <catch2/catch.hpp>

#include "bindings/lua/sandbox/strict_globals.hpp"
#include "engine/base/lua_text.hpp"
#include "machine_speed.hpp"
#include "sandbox_support.hpp"

namespace nezumi {
namespace {

std::string error_of(std::string_view source) {
    const auto chunk = compile(source, "a.lua");
    return chunk ? "compiles" : describe(chunk.error());
}

TEST_CASE("a quoted text is read by Lua as the same text", "[lua][compile]") {
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    Box box;
    CHECK(box.run("return " + lua_quoted(all)) == all);
    CHECK(box.run("return " + lua_quoted("\x01"
                                         "23\n\\n")) ==
          "\x01"
          "23\n\\n");
}

TEST_CASE("a text with a syntax error is refused with its line", "[lua][compile]") {
    CHECK(error_of("\nfunction on_execute( end") == "a.lua:2: <name> or '...' expected near 'end'");
    CHECK(error_of("x = 'abc") == "a.lua:1: unfinished string near <eof>");
    CHECK(error_of("x = 1\n\nif x then") == "a.lua:3: 'end' expected near <eof>");
    CHECK(error_of("goto nowhere") == "a.lua:1: no visible label 'nowhere' for <goto>");
    CHECK(error_of("break") == "a.lua:1: break outside loop");
    CHECK(error_of("function f()\n  g()\n  break\n  g()\nend\n") == "a.lua:3: break outside loop");
    CHECK(error_of("function f()\n  goto on\n  g()\nend\n") == "a.lua:2: no visible label 'on' for <goto>");
    CHECK(error_of("do\n  goto on\n  local x = 1\n  ::on:: x = 2\nend\n") ==
          "a.lua:2: <goto on> jumps into the scope of local 'x'");
    CHECK(error_of("if x then\n") == "a.lua:2: 'end' expected (to close 'if' at line 1) near <eof>");
    CHECK(error_of("local x <const> = 1 x = 2") == "a.lua:1: attempt to assign to const variable 'x'");
    CHECK(error_of("\x1bLua") == "a.lua:1: this is bytecode: only Lua source text can run");
    CHECK(error_of("\xEF\xBB\xBF\x1bLua") == "a.lua:1: this is bytecode: only Lua source text can run");
    for (const char* mark : {"\xFF\xFE", "\xFE\xFF"})
        CHECK(error_of(mark + std::string("x\0 =", 4)) == "a.lua:1: this is UTF-16: save the file as UTF-8");
    CHECK(error_of("#!\n\x1bLua").find("a.lua:2: unexpected symbol") == 0);
    CHECK(error_of(std::string((1 << 20) + 1, ' ')) == "a.lua: the file is too large: at most 1 MB");
    CHECK(error_of(std::string(1 << 20, ' ')) == "compiles");
    CHECK(error_of("") == "compiles");
    CHECK(error_of("#only a comment") == "compiles");
    CHECK(error_of("#!/usr/bin/lua\r\nreturn 1 +").find("a.lua:2: ") == 0);
    CHECK(error_of("\xEF\xBB\xBF#!x\nreturn 1") == "compiles");
    CHECK(error_of(std::string("return '\0'", 10)) == "compiles");
    CHECK(error_of(std::string("return \0", 8)).find("a.lua:1: unexpected symbol") == 0);
}

TEST_CASE("code that is nested too deeply is refused with its line", "[lua][compile]") {
    const auto nested = [](const std::string& open, const std::string& close) {
        std::string text = "\n\nreturn ";
        for (int i = 0; i < 10'000; ++i) text += open;
        text += "1";
        for (int i = 0; i < 10'000; ++i) text += close;
        return error_of(text);
    };
    CHECK(nested("(", ")") == "a.lua:3: the code is nested too deeply");
    CHECK(nested("{", "}") == "a.lua:3: the code is nested too deeply");
    CHECK(nested("- ", "") == "a.lua:3: the code is nested too deeply");
    CHECK(nested("2 ^ ", "") == "a.lua:3: the code is nested too deeply");
    CHECK(nested("function() return ", " end") == "a.lua:3: the code is nested too deeply");
    CHECK(nested("1 + ", "") == "compiles");
}

TEST_CASE("a text that takes too long to compile is refused", "[lua][compile]") {
    std::string text;
    for (int i = 0; i < 180; ++i) {
        text += "local function f" + std::to_string(i) + "() local a0";
        for (int j = 1; j < 180; ++j) text += ",a" + std::to_string(j);
        text += "\n";
    }
    while (text.size() < 1'000'000) text += "x()\n";
    for (int i = 0; i < 180; ++i) text += " end";
    const std::int64_t began = thread_time();
    CHECK(error_of(text) == "a.lua: takes too long to compile");
    CHECK(static_cast<double>(thread_time() - began) * 1e-9 < compile_seconds_limit + 2 * slowness());
}

TEST_CASE("many states load one chunk", "[lua][compile]") {
    const Chunk chunk = compile("local n = 0 return function() n = n + 1 return n end", "a.lua").value();
    Box a;
    Box b;
    for (Box* box : {&a, &b}) {
        REQUIRE(load_chunk(box->lua(), chunk));
        REQUIRE(protected_call(box->lua(), 0, 1, paced_budget));
        REQUIRE(protected_call(box->lua(), 0, 1, paced_budget));
        CHECK(lua_tointeger(box->lua(), -1) == 1);
    }
}

TEST_CASE("loading a chunk without memory is an error", "[lua][compile]") {
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += "local x" + std::to_string(i % 100) + " = 'some text " + std::to_string(i) + "' do ";
    for (int i = 0; i < 1000; ++i) text += " end";
    Box box;
    text = "return {";
    for (int i = 0; i < 1000; ++i) text += "'some text " + std::to_string(i) + "', ";
    const Chunk chunk = compile(text + "}", "a.lua").value();
    box.state->set_memory_limit(box.state->memory() + 1000);
    const auto loaded = load_chunk(box.lua(), chunk);
    REQUIRE_FALSE(loaded);
    CHECK(loaded.error().message.find("not enough memory: the script reached its limit of ") == 0);
    CHECK(lua_gettop(box.lua()) == 0);
}

TEST_CASE("unknown globals are errors at run time", "[lua][strict]") {
    Box box;
    lua_pushinteger(box.lua(), 1);
    lua_setglobal(box.lua(), "speed");
    REQUIRE(make_globals_strict(box.lua(), {"on_execute", "on_reset"}));
    CHECK(box.run("return speeed") == "box.lua:1: unknown global 'speeed' (did you mean 'speed'?)");
    CHECK(box.run("return something") == "box.lua:1: unknown global 'something'");
    CHECK(box.run("counter = 1") == "box.lua:1: unknown global 'counter'");
    CHECK(box.run("on_exeucte = 1") == "box.lua:1: unknown global 'on_exeucte' (did you mean 'on_execute'?)");
    CHECK(box.run("return on_execute, speed") == "nil 1");
    CHECK(box.run("function on_execute() return 'called' end return on_execute(), on_reset") == "called nil");
    CHECK(box.run("on_execute = nil return on_execute") == "nil");
    CHECK(box.run("return pcall(function() return undefined end)") == "false box.lua:1: unknown global 'undefined'");
}

}  // namespace
}  // namespace nezumi

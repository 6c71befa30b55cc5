// The system's words as methods of an object, as scenarios use them.
#include "bindings/lua/files/system_lua.hpp"

#include <catch2/catch.hpp>

#include "bindings/lua/sandbox/call.hpp"
#include "bindings/lua/sandbox/compile.hpp"
#include "bindings/lua/sandbox/stdlib.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

// A Lua state with the words as methods of `s`, and the arena's things as globals.
struct Methods {
    Methods()
        : project(Project::of(std::filesystem::path(source_root()) / "tests/scenarios/t.lua", {source_root()})),
          words(project) {
        host.words = &words;
        state = std::move(*create_sandbox());
        const auto installed = protect(state->lua(), headless_budget, [&](lua_State* lua) {
            lua_createtable(lua, 0, 0);
            add_system_words(lua, host, true);
            lua_setglobal(lua, "s");
            lua_pushglobaltable(lua);
            add_system_words(lua, host, false);
            return 0;
        });
        REQUIRE(installed.has_value());
    }

    std::string run(std::string_view text) {
        REQUIRE(load_chunk(state->lua(), *compile(text, "t.lua")).has_value());
        const auto ran = protected_call(state->lua(), 0, 0, headless_budget);
        return ran ? "" : describe(ran.error());
    }

    Project project;
    SystemWords words;
    WordHost host;
    std::unique_ptr<LuaState> state;
};

}  // namespace

TEST_CASE("the words are also methods of an object", "[lua][system_words]") {
    Methods methods;
    CHECK(methods.run(R"(
        s:robot "mouse" { model = "raspimouse" }
        s:behavior("controller", { script = "robot_controller" })
        s:connect("mouse.ir_sensor_out", "controller.in")
        s:arena { box { at = { 1, 0 }, size = { 0.1, 1, 0.1 } } }
        s:rate(50))") == "");
    const SystemSpec& spec = methods.words.spec();
    CHECK(spec.entries.size() == 2);
    CHECK(spec.connections.size() == 1);
    CHECK(spec.arena.boxes.size() == 1);
    CHECK(spec.rate == 50);
    CHECK(methods.words.finish().has_value());
}

TEST_CASE("an error of a method is a Lua error, which pcall catches", "[lua][system_words]") {
    Methods methods;
    CHECK(methods.run("s:robot('mouse', { model = 'raspimous' })").substr(0, 65) ==
          "t.lua:1: robot 'mouse': there is no robot model 'raspimous' (did ");
    CHECK(methods.run("assert(not pcall(s.rate, s, -1))\ns:rate(20)") == "");
    CHECK(methods.words.spec().rate == 20);
}

TEST_CASE("words extend a system that was read before", "[lua][system_words]") {
    Methods methods;
    REQUIRE(methods.run("s:robot 'mouse' { model = 'raspimouse' }").empty());
    SystemWords more(methods.project, {}, methods.words.spec());
    methods.host.words = &more;
    CHECK(methods.run("s:behavior('mouse', { script = 'robot_controller' })") ==
          "t.lua:1: behavior 'mouse': the name is already used by the robot at t.lua:1");
    CHECK(methods.run("s:behavior('c', { script = 'robot_controller' })") == "");
    CHECK(more.spec().entries.size() == 2);
}

// Matrices within the sandbox: their memory, their place in `state` and in commands, and what a script may try with
// them. What they compute is tested by tests/scenarios/matrix_module_test.lua.
#include <catch2/catch.hpp>

#include "tests/unit/lua/reload_rig.hpp"
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

const Text with_matrix = "local matrix = require 'native.matrix'\n";

Text matrix_error(const Text& body, ScriptContext context = {}) {
    ScriptRig rig(with_matrix + "function on_execute()\n" + body + "\nend", std::move(context));
    rig.activate().tick();
    return rig.status() == "ERROR" ? rig.error() : "";
}

}  // namespace

TEST_CASE("the memory of matrices counts as memory of the script", "[lua][matrix]") {
    CHECK(matrix_error("state.all = {} for i = 1, 1e6 do state.all[i] = matrix.zeros(64, 64) end",
                       {.memory_limit = std::size_t{4} << 20}) ==
          "robot_controller.lua:3: not enough memory: the script reached its limit of 4 MB");
    CHECK(matrix_error("for i = 1, 2000 do local m = matrix.zeros(64, 64) end",
                       {.budget = headless_budget, .memory_limit = std::size_t{4} << 20}) == "");
}

TEST_CASE("an endless calculation ends with the script's time", "[lua][matrix][watchdog]") {
    CHECK(matrix_error("local m = matrix.identity(64) while true do m = m:solve(m) end", {.budget = {0.1}}) ==
          "robot_controller.lua:3: ran for more than 0.1 s: is there an endless loop?");
}

TEST_CASE("scripts can't change the methods of a matrix", "[lua][matrix]") {
    CHECK(matrix_error(R"(
        local m = matrix { { 1, 2 } }
        assert(not pcall(setmetatable, m, {}) and not pcall(rawset, m, 1, 2) and not pcall(rawget, m, 1))
        assert(getmetatable(m) == false and getmetatable(m[1]) == false and getmetatable(matrix) == false)
        assert(not pcall(function() return m < m end) and not pcall(function() return m .. m end))
        assert(not pcall(m.transpose, matrix) and not pcall(m.solve, m[1], m) and not pcall(m.to_table))
        assert(not pcall(function() m[1] = m end) and not pcall(function() m[1][1] = m end)))") == "");
}

TEST_CASE("after a reload, a matrix in state is a table of its rows", "[lua][matrix][reload]") {
    ReloadRig world;
    const Text text = with_matrix +
                      "local out = output('out', 'TimedString')\nstate.p = matrix(state.p or { { 4, 1 }, { 2, 3 } })\n"
                      "state.row = state.row or state.p[2]\n"
                      "function on_execute() state.p = state.p * 2 out:write(tostring(state.p)) end";
    world.add_text("keeper", text);
    world.tick(2);
    CHECK(world.change("keeper.lua", text + "\nassert(state.row[2] == 3 and type(state.row) == 'table')") == "");
    for (const Text& note : world.notes) CHECK(note.find("plain data") == Text::npos);
    world.tick(2);
    CHECK(world.out<Text>("keeper.out") == "{ { 64.0, 16.0 }, { 32.0, 48.0 } }");
}

TEST_CASE("a matrix in state is reported as dropped when a version goes back", "[lua][matrix]") {
    ScriptRig rig(with_matrix + "param('k', 1) state.n = 1 state.p = matrix { { 1.5 } } state.row = state.p[1]");
    std::vector<Dropped> dropped;
    const auto kept = rig.component->script().state_snapshot({}, &dropped);
    REQUIRE(kept);
    CHECK(kept->data.tables == std::vector<PlainData::Table>{{{"n", std::int64_t{1}}}});
    CHECK(dropped == std::vector<Dropped>{{"state.p", "a matrix"}, {"state.row", "a matrix"}});
    // Whoever just looks sees the numbers.
    const auto look = rig.component->state_snapshot({});
    REQUIRE(look);
    CHECK(look->data.tables.size() == 4);
}

TEST_CASE("a command returns a matrix as a table of its rows", "[lua][matrix]") {
    ScriptRig rig(with_matrix + "command('p', function() return matrix { { 1.5 } } end)");
    rig.activate();
    const auto result = rig.component->call_command("p", {}, rig.now);
    REQUIRE(result);
    REQUIRE(result->tables.size() == 2);
    CHECK(result->tables[1] == PlainData::Table{{std::int64_t{1}, 1.5}});
}

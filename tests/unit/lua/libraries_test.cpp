// The libraries of Lua that a script holds.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

TEST_CASE("libraries are created at their first use, and are the same as before", "[lua][sandbox]") {
    const std::string named = R"(
        local text = output("text", "TimedString")
        function on_execute()
          local _, floor = pcall(math.floor, {})
          local _, upper = pcall(string.upper)
          local _, insert = pcall(table.insert, 1, 2)
          text:write(("%s|%s|%s|%s|%s|%s"):format(floor, upper, insert, ("x"):upper(), "10" + 1, utf8.char(65)))
          assert(math == math and coroutine.isyieldable() == false and ("x").nothing == nil and string.len("ab") == 2)
          assert(not pcall(function() math.pi = 3 end) and #"ab" == ("ab"):len())
        end
    )";
    ScriptRig rig(named);
    rig.activate().tick();
    CHECK(rig.error() == "");
    CHECK(rig.out<std::string>("text").read() ==
          "bad argument #1 to 'math.floor' (number expected, got table)|bad argument #1 to 'string.upper' (string "
          "expected, got no value)|bad argument #1 to 'table.insert' (table expected, got number)|X|11|A");
    const ScriptRig bare("function on_execute() end");
    CHECK(bare.component->script().memory() + 4000 < rig.component->script().memory());
    CHECK(refusal("maths.floor(1)").find("unknown global 'maths'") != std::string::npos);
}

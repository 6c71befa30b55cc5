// Structures that a behaviour writes without making a table.
#include "bindings/lua/syntax/field_writes.hpp"

#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

const std::string declared = "local out = output('o', 'TimedVelocity2D')\n";

struct Edited {
    std::string text;  // "": no edits
    std::vector<FieldWrite> writes;
};

Edited edited(const std::string& text) {
    const SyntaxTree tree(text);
    REQUIRE(tree.error() == nullptr);
    TextEdits edits(tree);
    std::vector<FieldWrite> writes = edit_field_writes(tree, edits);
    return {edits.empty() ? "" : edits.text(), std::move(writes)};
}

// The text of this statement; "" if it stays.
std::string flat(const std::string& statement) {
    const std::string text = edited(declared + statement).text;
    return text.empty() ? "" : text.substr(declared.size());
}

// What a behaviour with this execution writes, or its error.
std::string written(const std::string& body) {
    ScriptRig rig(declared + "local function two() return 1, 2 end\nfunction on_execute()\n" + body + "\nend");
    rig.activate().tick();
    if (rig.status() == "ERROR") return rig.error();
    const Velocity2D& value = rig.out<Velocity2D>("o").read();
    return std::to_string(value.vx) + " " + std::to_string(value.vy) + " " + std::to_string(value.va);
}

}  // namespace

TEST_CASE("a table of fields that is written becomes arguments, and all lines stay", "[lua][port]") {
    CHECK(flat("out:write { vx = 1, va = x }") == "out:write_1 (   1,   (x)) ");
    CHECK(flat("out:write({ vx = 1; va = f(), })") == "out:write_1(   1,   (f())) ");
    CHECK(flat("out:write {\n  vx = 1, -- m/s\n  va = 2,\n}\nreturn 3") ==
          "out:write_1 (\n    1, -- m/s\n    (2))\n\nreturn 3");
    const Edited two = edited(declared + "out:write { va = 1 } out:write { vx = 2, va = 3 } out:write { va = 4 }");
    CHECK(two.writes == std::vector<FieldWrite>{{"o", {"va"}}, {"o", {"vx", "va"}}});
    CHECK(two.text == declared + "out:write_1 (   (1))  out:write_2 (   2,   (3))  out:write_1 (   (4)) ");
    CHECK(flat("out:write { va = f(function() out:write { va = 2 } end) }") ==
          "out:write_1 (   (f(function() out:write_1 (   (2))  end))) ");
}

TEST_CASE("another call, or a call of another variable, stays", "[lua][port]") {
    for (const std::string statement :
         {"out:write(v)", "out:write {}", "out:write { 1, 2 }", "out:write { ['vx'] = 1 }", "out:write { vx = 1, 2 }",
          "out:write { vx = 1, vx = 2 }", "out:write({ vx = 1 }, 2)", "out.write { vx = 1 }", "out:read { vx = 1 }",
          "other:write { vx = 1 }", "local v = { vx = 1 } out:write(v)", "out = f() out:write { vx = 1 }",
          "do local out = f() out:write { vx = 1 } end"}) {
        INFO(statement);
        CHECK(flat(statement).empty());
    }
    CHECK(edited("local out = input('o', 'TimedVelocity2D') out:write { vx = 1 }").text.empty());
}

TEST_CASE("fields that are written without a table have the same values and the same errors", "[lua][port]") {
    CHECK(written("out:write { vx = 0.5, va = -1 }") == "0.500000 0.000000 -1.000000");
    CHECK(written("out:write { vx = 7, vy = 7, va = 7 } out:write { va = two() }") == "0.000000 0.000000 1.000000");
    CHECK(written("out:write { vx = nil, va = 2 }") == "0.000000 0.000000 2.000000");
    const auto same = [](const std::string& fields) {
        std::string error = written("out:write { " + fields + " }");
        CHECK(error == written("local v = { " + fields + " } out:write(v)"));
        return error;
    };
    CHECK(same("vx = 'fast'") ==
          "robot_controller.lua:4: output 'o' (TimedVelocity2D): field 'vx' expected a number, got string");
    CHECK(same("va = 1, vx = 0 / 0") ==
          "robot_controller.lua:4: output 'o' (TimedVelocity2D): field 'vx' expected a finite number, got nan");
    CHECK_THAT(same("vz = 1"), Catch::Contains("vz"));
    CHECK(same("vz = nil, va = 3") == "0.000000 0.000000 3.000000");
    CHECK_THAT(same("vx = two().x"), Catch::Contains("attempt to index a number value"));
    // Both before it can be written.
    CHECK(refusal(declared + "out:write { vx = 1 }") ==
          "robot_controller.lua:2: output 'o': ports can't be written while the file loads");
}

TEST_CASE("structures within a structure, and values of other types, are written as they are in a table",
          "[lua][port]") {
    ScriptRig rig(
        "local pose = output('pose', 'TimedPose2D')\n"
        "local text = output('text', 'TimedString')\n"
        "function on_execute()\n"
        "  pose:write { heading = 3, position = { x = 1, y = 2 } }\n"
        "  local ok, why = pcall(function() text:write { data = 1 } end)\n"
        "  log.info(tostring(why))\n"
        "end");
    rig.activate().tick();
    CHECK(rig.out<Pose2D>("pose").read() == Pose2D{{1, 2}, 3});
    REQUIRE(rig.log.size() == 1);
    CHECK_THAT(rig.log[0], Catch::EndsWith("output 'text' (TimedString): expected a string, got table"));
}

TEST_CASE("writing fields makes no garbage", "[lua][port]") {
    ScriptRig rig(declared + "local n = 0\nfunction on_execute() n = n + 1 out:write { vx = n, va = -n } end");
    rig.activate().tick(2);
    const std::size_t before = rig.component->script().memory();
    rig.tick(5);
    CHECK(rig.component->script().memory() == before);
}

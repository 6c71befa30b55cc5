// Probes: what a script shows of its inside.
#include <fmt/format.h>

#include "tests/unit/leaf_text.hpp"
#include "tests/unit/lua/reload_rig.hpp"
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

// What recordings take of a component's probes: "name=value" joined by blanks.
Text recorded(const Component& component) {
    Text text;
    CHECK(component.visit_member("probes", [&](const LeafPath& path, const ValueView& leaf) {
        text += (text.empty() ? "" : " ") + path.text() + "=";
        text += text_of(leaf);
    }));
    return text;
}

// What an execution with this body says when it fails.
Text probe_failure(const Text& body) {
    ScriptRig rig("param('gains', { 1.0, 2.0 }) function on_execute() " + body + " end");
    rig.activate().tick();
    return rig.status() == "ERROR" ? rig.error() : "";
}

}  // namespace

TEST_CASE("the last value of a tick counts, and stays until the next", "[lua][probes]") {
    ScriptRig rig(
        "function on_execute() probe('early', 1) probe('early', now()) if now() < 0.015 then probe('seen', true) end "
        "end");
    CHECK(recorded(*rig.component).empty());
    rig.activate().tick(3);
    CHECK(recorded(*rig.component) == "early=0.02 seen=true");
    const auto& all = rig.component->script().probes().all();
    REQUIRE(all.size() == 2);
    CHECK(all[0].tm == 0.02);
    CHECK(all[1].tm == 0.01);
}

TEST_CASE("a probe takes numbers, truth values, texts and flat tables", "[lua][probes]") {
    ScriptRig rig(
        "param('gains', { 1.0, 2.5 }) function on_execute() probe('a', 1) probe('b', 1.5) probe('c', false) "
        "probe('d', 'text') probe('e', { 3, 4, x = true }) probe('f', config.gains) probe('g', {}) end");
    rig.activate().tick();
    CHECK(recorded(*rig.component) == "a=1 b=1.5 c=false d=text e[1]=3 e[2]=4 e.x=true f[1]=1 f[2]=2.5");
}

TEST_CASE("what is no value of a probe is an error that says what is", "[lua][probes]") {
    const Text at = "robot_controller.lua:1: ";
    const Text takes = "expected a number, a truth value, a text or a flat table of them, got ";
    CHECK(probe_failure("probe('p', 1) probe('p', config.gains)").empty());
    CHECK(probe_failure("probe('p', print)") == at + "probe 'p': " + takes + "function");
    CHECK(probe_failure("probe('p', nil)") == at + "probe 'p': " + takes + "nothing");
    CHECK(probe_failure("probe('p', { { 1 } })") == at + "probe 'p': " + takes + "a table that holds something else");
    CHECK(probe_failure("probe('p', { [print] = 1 })") ==
          at + "probe 'p': " + takes + "a table that holds something else");
    CHECK(probe_failure("local t = {} for i = 1, 64 do t[i] = i end probe('p', t)").empty());
    CHECK(probe_failure("local t = {} for i = 1, 65 do t[i] = i end probe('p', t)") ==
          at + "probe 'p': a table has at most 64 entries here");
    CHECK(probe_failure("probe('p', ('x'):rep(1000))").empty());
    CHECK(probe_failure("probe('p', ('x'):rep(1001))") == at + "probe 'p': its texts have at most 1000 bytes");
    CHECK(probe_failure("probe('p', { ('x'):rep(500), ('x'):rep(501) })") ==
          at + "probe 'p': its texts have at most 1000 bytes");
    CHECK(probe_failure("probe('a b', 1)") ==
          at +
              "probe 'a b': the name is no identifier: use letters, digits and _, no digit first, at most 100 of them");
    CHECK(probe_failure("probe(1, 1)") == at + "probe expected a name, got number");
    CHECK(refusal("probe('p', 1) param('x', 1)") == at + "probe 'p': nothing can be probed while the file loads");
    CHECK(refusal("param('probe', 1)") ==
          at + "parameter 'probe': the name is one of a component's own words: choose another, as 'my_probe'");
}

TEST_CASE("a component has at most 64 probes", "[lua][probes]") {
    CHECK(probe_failure("for i = 1, 64 do probe('p' .. i, i) end probe('p1', 0)").empty());
    CHECK(probe_failure("for i = 1, 65 do probe('p' .. i, i) end") ==
          "robot_controller.lua:1: probe 'p65': a component has at most 64 probes");
}

TEST_CASE("a probe is kept when the execution fails: it tells why", "[lua][probes]") {
    ScriptRig rig(
        "local out = output('out', 'TimedLong') function on_execute() probe('step', 3) out:write(1) error('no') end");
    rig.activate().tick();
    CHECK(rig.status() == "ERROR");
    CHECK(recorded(*rig.component) == "step=3");
    CHECK(rig.out<std::int32_t>("out").count() == 0);
}

TEST_CASE("tasks, commands and modules probe as well", "[lua][probes]") {
    ReloadRig world;
    world.write("helper.lua", "return function() probe('module', 1) end");
    world.write("it.lua",
                "local help = require 'helper'\ntask('t', function() probe('task', 2) end)\n"
                "command('c', function() probe('command', 3) end)\nfunction on_execute() help() end");
    ScriptComponent& it = world.add("it", "it.lua");
    world.tick();
    REQUIRE(it.call_command("c", {}, world.system.now()));
    CHECK(recorded(it) == "command=3 module=1 task=2");
}

TEST_CASE("a reload empties the probes, and so does the way back", "[lua][probes][reload]") {
    ReloadRig world;
    ScriptComponent& it = world.add_text("it", "function on_execute() probe('old', 1) end");
    world.tick();
    CHECK(recorded(it) == "old=1");
    CHECK(world.change("it.lua", "function on_execute() probe('new', 2) end") == "");
    CHECK(recorded(it).empty());
    world.tick();
    CHECK(recorded(it) == "new=2");
    REQUIRE(world.reloader.rollback(it));
    CHECK(recorded(it).empty());
}

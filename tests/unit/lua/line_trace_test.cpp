// Executions that are looked at line by line: what is seen, and that nothing is other than without.
#include <algorithm>
#include <string>

#include "bindings/lua/sandbox/line_trace.hpp"
#include "tests/unit/live_rig.hpp"
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

// "3 near = 7": the line, and the variable's value behind it; "" when that line did not run or names no such variable.
std::string value_at(const TracedLines& seen, int line, const std::string& name) {
    for (const TracedLines::Line& each : seen.lines) {
        if (each.line != line) continue;
        for (const TracedLines::Value& value : each.values) {
            if (value.name == name) return value.text;
        }
    }
    return "";
}

std::vector<int> numbers_of(const TracedLines& seen) {
    std::vector<int> numbers;
    for (const TracedLines::Line& line : seen.lines) numbers.push_back(line.line);
    return numbers;
}

}  // namespace

TEST_CASE("a trace has the executed lines in order, with their variables after each line", "[lua][explain]") {
    ScriptRig rig(R"(local out = output("out", "TimedDouble")
local count = 0
local function twice(x)
  local y = x * 2
  return y
end
function on_execute()
  count = count + 1
  local near = twice(count + 3)
  if near > 100 then
    near = 0
  end
  local list = { 1, 2.5, "three" }
  local named = { vx = 0.5 }
  out:write(near)
end
)");
    rig.activate();
    CHECK(rig.component->trace_next() == 1);
    rig.tick();
    CHECK(rig.component->traces() == 1);
    const TracedLines& seen = rig.component->latest_trace();
    CHECK_FALSE(seen.is_cut);
    CHECK(numbers_of(seen) == std::vector<int>{8, 9, 4, 5, 10, 13, 14, 15, 16});
    CHECK(value_at(seen, 8, "count") == "1");
    CHECK(value_at(seen, 4, "x") == "4");
    CHECK(value_at(seen, 4, "y") == "8");
    CHECK(value_at(seen, 9, "near") == "8");
    CHECK(value_at(seen, 13, "list") == R"({ 1, 2.5, "three" })");
    CHECK(value_at(seen, 14, "named") == "{ vx = 0.5 }");
    CHECK(seen.lines[2].depth == seen.lines[1].depth + 1);
    CHECK(seen.lines[0].file == "robot_controller.lua");
}

TEST_CASE("a trace has parameters and state after each line", "[lua][explain]") {
    ScriptRig rig(R"(param("gain", 0.5)
state.count = 3
function on_execute()
  state.count = state.count + 1
  state.list = { 1, 2 }
end
)");
    rig.activate();
    rig.component->trace_next();
    rig.tick();
    const TracedLines& seen = rig.component->latest_trace();
    CHECK(value_at(seen, 4, "config.gain") == "0.5");
    CHECK(value_at(seen, 4, "state.count") == "4");
    CHECK(value_at(seen, 4, "state.list").empty());
    CHECK(value_at(seen, 5, "state.list") == "{ 1, 2 }");
}

TEST_CASE("a trace shows no fields of a table with more than 1000: which come first in memory is chance",
          "[lua][explain]") {
    ScriptRig rig(R"(function on_execute()
  local few, many = {}, {}
  for i = 1, 1000 do few["a" .. i], many["a" .. i] = i, i end
  many.b = 1
  local last = 0
end
)");
    rig.activate();
    rig.component->trace_next();
    rig.tick();
    const TracedLines& seen = rig.component->latest_trace();
    CHECK(value_at(seen, 5, "few").starts_with("{ a1 = 1, a10 = 10, a100 = 100, "));
    CHECK(value_at(seen, 5, "many") == "{ ... }");
}

TEST_CASE("only the requested execution is traced, and no hook remains", "[lua][explain]") {
    ScriptRig rig("function on_execute()\n  local x = 1\nend\n");
    rig.activate().tick();
    CHECK(rig.component->traces() == 0);
    rig.component->trace_next();
    rig.tick(3);
    CHECK(rig.component->traces() == 1);
    CHECK(lua_gethook(rig.component->script().lua()) == nullptr);
    CHECK(rig.component->trace_next() == 2);
    rig.tick();
    CHECK(rig.component->traces() == 2);
}

TEST_CASE("lines of tasks are traced, and no hook remains in their coroutines", "[lua][explain]") {
    ScriptRig rig(R"(task("count", function()
  local n = 0
  while true do
    n = n + 1
    wait(0.01)
  end
end)
)");
    rig.activate().tick(2);
    rig.component->trace_next();
    rig.tick();
    CHECK_FALSE(value_at(rig.component->latest_trace(), 4, "n").empty());
    const std::size_t lines = rig.component->latest_trace().lines.size();
    rig.tick(3);
    CHECK(rig.component->latest_trace().lines.size() == lines);
}

TEST_CASE("a trace is limited, but the execution continues", "[lua][explain]") {
    std::string text = "local out = output('out', 'TimedDouble')\nfunction on_execute()\n  local sum = 0\n";
    for (int i = 0; i < 400; ++i) text += "  sum = sum + 1\n";
    ScriptRig rig(text + "  out:write(sum)\nend\n");
    rig.activate();
    rig.component->trace_next();
    rig.tick();
    CHECK(rig.component->latest_trace().is_cut);
    CHECK(rig.component->latest_trace().lines.size() == LineTrace::most_lines);
    CHECK(rig.out<double>("out").value().get<double>() == 400.0);
    CHECK(lua_gethook(rig.component->script().lua()) == nullptr);
}

TEST_CASE("a trace has the first rounds of a long loop, the last one, and the lines after it", "[lua][explain]") {
    ScriptRig rig(R"(local out = output("out", "TimedDouble")
function on_execute()
  local sum = 0
  for i = 1, 1000 do
    sum = sum + i
  end
  out:write(sum)
end
)");
    rig.activate();
    rig.component->trace_next();
    rig.tick();
    const TracedLines seen = rig.component->latest_trace();
    CHECK_FALSE(seen.is_cut);
    CHECK(seen.lines.size() < 14);
    CHECK(seen.lines.back().line == 8);  // the end of the function
    std::size_t left_out = 0;
    for (const auto& line : seen.lines) left_out += line.turns_left_out;
    CHECK(left_out > 990);
    CHECK(value_at(seen, 7, "sum") == "500500");
}

TEST_CASE("an error in a traced execution is the same, and the trace has the lines before it", "[lua][explain]") {
    const std::string text = "function on_execute()\n  local x = 1\n  error('no luck')\nend\n";
    ScriptRig plain(text), looked(text);
    plain.activate().tick();
    looked.activate();
    looked.component->trace_next();
    looked.tick();
    CHECK(looked.error() == plain.error());
    CHECK(numbers_of(looked.component->latest_trace()) == std::vector<int>{2, 3});
}

TEST_CASE("an endless loop that is traced still ends at its time limit", "[lua][explain][wallclock]") {
    ScriptRig rig("function on_execute()\n  while true do local x = 1 end\nend\n");
    rig.activate();
    rig.component->trace_next();
    rig.tick();
    CHECK(rig.status() == "ERROR");
    CHECK(rig.error().find("ran for more than 0.1 s") != std::string::npos);
}

TEST_CASE("a traced run has the same hash as a run without traces", "[lua][explain]") {
    const std::string behavior = R"(
local range = input("in", "TimedShortSeq", "")
local target = output("out", "TimedVelocity2D", "")
param("speed_x", 0.1)
state.count = 0
task("wink", function() while true do state.count = state.count + math.random(3) wait(0.05) end end)
function on_execute()
  local texts = {}
  for i = 1, 20 do texts[i] = ("%d"):rep(i):format(table.unpack({ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20 })) end
  local walk = coroutine.wrap(function() for i = 1, 3 do coroutine.yield(i * math.random()) end end)
  target:write { vx = 0.1 + walk() * 0.01, va = (state.count % 5) * 0.1 + #texts[20] * 1e-4 }
end
)";
    std::vector<std::uint64_t> hashes;
    for (const bool looks : {false, true}) {
        LiveRig rig(counter_system, {{"counter", behavior}});
        for (int i = 0; i < 300; ++i) {
            if (looks) REQUIRE(rig.live->explain_next("controller"));
            rig.tick();
        }
        CHECK(rig.component("controller").state() == LifeState::active);
        hashes.push_back(rig.live->trace_hash());
    }
    CHECK(hashes[0] == hashes[1]);
}

TEST_CASE("an explanation contains the sensor's port, the lines and the wheels", "[lua][explain]") {
    LiveRig rig;
    rig.tick(50);
    const auto look = rig.live->explain_next("controller");
    REQUIRE(look);
    CHECK_FALSE(*rig.live->explanation("controller", *look));
    rig.tick();
    const auto seen = *rig.live->explanation("controller", *look);
    REQUIRE(seen);
    CHECK(seen->component == "controller");
    CHECK(seen->tick == 50);
    REQUIRE(seen->inputs.size() == 1);
    CHECK(seen->inputs[0].port == "controller.in");
    CHECK(seen->inputs[0].peers == std::vector<std::string>{"mouse.ir_sensor_out"});
    CHECK(seen->inputs[0].value.find("{ ") == 0);
    const auto loop = std::find_if(seen->traced.lines.begin(), seen->traced.lines.end(),
                                   [](const auto& line) { return line.text.find("if value > config.stop_d") == 0; });
    REQUIRE(loop != seen->traced.lines.end());
    REQUIRE(loop->values.size() == 2);  // those that the line names
    CHECK(loop->values[0].name == "value");
    CHECK(loop->values[1] == TracedLines::Value{"config.stop_d", "30"});
    CHECK(seen->traced.lines.back().file.find("counter.lua") != std::string::npos);
    REQUIRE(seen->outputs.size() == 1);
    CHECK(seen->outputs[0].peers == std::vector<std::string>{"mouse.target_velocity_in"});
    REQUIRE(seen->robots.size() == 1);
    CHECK(seen->robots[0].robot == "mouse");
    CHECK(seen->robots[0].asked.vx == 0.25);
    CHECK(seen->robots[0].wheels_told);
    const std::string text = to_text(*seen);
    CHECK(text.find("controller.in <- mouse.ir_sensor_out: { ") != std::string::npos);
    CHECK(text.find("mouse was commanded vx = 0.25 m/s") != std::string::npos);
    CHECK(text.find("mouse's wheels: left ") != std::string::npos);
}

TEST_CASE("an explanation that is impossible is refused with the reason", "[lua][explain]") {
    LiveRig rig;
    CHECK(rig.live->explain_next("mouse").error().message == "mouse is not a behaviour: it has no lines");
    CHECK(rig.live->explain_next("contoller").error().message.find("controller") != std::string::npos);
    REQUIRE(rig.live->act(Deactivate{"controller"}, {}));
    CHECK(rig.live->explain_next("controller").error().message ==
          "controller is INACTIVE: only ACTIVE components are executed");
    CHECK(rig.live->explanation("nobody", 1).error().message == "nobody is gone");
}

// Port objects in Lua: values in, values out, their properties, and what is said when they are misused.
#include "tests/unit/lua/rig.hpp"

using namespace nezumi;

namespace {

using Shorts = std::vector<std::int16_t>;
const std::string echo = R"(
local from = input("from", "TimedShortSeq")
local to = output("to", "TimedShortSeq")
function on_execute() to:write(from:read()) end
)";

}  // namespace

TEST_CASE("a script reads the latest value of an in-port and writes an out-port", "[lua][ports]") {
    ScriptRig rig(echo);
    rig.activate();
    rig.tick();
    CHECK(rig.out<Shorts>("to").read().empty());  // an empty sequence before anything came
    rig.feed("from", Shorts{1});
    rig.feed("from", Shorts{1, 2, 3});
    rig.tick();
    CHECK(rig.out<Shorts>("to").read() == Shorts{1, 2, 3});
    rig.tick();
    CHECK(rig.out<Shorts>("to").read() == Shorts{1, 2, 3});  // it stays the latest
}

TEST_CASE("what is read is the script's own copy", "[lua][ports]") {
    ScriptRig rig(R"(
local from = input("from", "TimedPose2D")
function on_execute()
  local pose = from:read()
  pose.position.x = 100
  pose.extra = true
  assert(from:read().position.x == 7 and from:read().extra == nil)
end)");
    rig.activate();
    rig.feed("from", Pose2D{.position = {7, 0}});
    rig.tick();
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("before anything came an in-port reads its type's zero value", "[lua][ports]") {
    CHECK(failure_of(R"(
local n, t, v, i = input("n", "TimedLong"), input("t", "TimedString"), input("v", "TimedVelocity2D"), input("i", "CameraImage"))",
                     "assert(n:read() == 0 and t:read() == '' and v:read().va == 0 and i:read().pixels == '')") == "");
}

TEST_CASE("a queue gives the oldest unread message, then the last one again", "[lua][ports]") {
    ScriptRig rig(R"(
local from = input("from", "TimedLong", "", { queue = 3 })
local to = output("to", "TimedLongSeq")
function on_execute()
  local all = {}
  while from.is_new do all[#all + 1] = from:read() end
  all[#all + 1] = from:read()
  to:write(all)
end)");
    rig.activate();
    for (std::int32_t i = 1; i <= 3; ++i) rig.feed("from", i);
    rig.tick();
    CHECK(rig.out<std::vector<std::int32_t>>("to").read() == std::vector<std::int32_t>{1, 2, 3, 3});
}

TEST_CASE("an execution that writes without end is an error before it fills the memory", "[lua][ports]") {
    const auto error_of = [](const std::string& body) {
        ScriptRig rig(
            "local a = output('a', 'TimedString') local b = output('b', 'TimedVelocity2D')\nfunction on_execute()\n" +
                body + "\nend",
            {.budget = Budget{20}});
        rig.activate().tick();
        return rig.error();
    };
    CHECK(error_of("local text = ('x'):rep(1e7)\nfor i = 1, 1e4 do a:write(text) end") ==
          "robot_controller.lua:4: output 'a' (TimedString): is there an endless loop? It has written more than 64 MB "
          "in one execution");
    CHECK(error_of("while true do b:write {} end") ==
          "robot_controller.lua:3: output 'b' (TimedVelocity2D): is there an endless loop? It has written more than 64 "
          "MB in one execution");
    ScriptRig rig("local a = output('a', 'TimedString') function on_execute() a:write(('x'):rep(1e7)) end",
                  {.budget = Budget{20}});
    rig.activate().tick(10);  // each execution counts anew
    CHECK(rig.status() == "ACTIVE");
}

TEST_CASE("an execution that logs without end is cut short, and the next one is heard", "[lua][ports]") {
    ScriptRig rig("local text = ('x'):rep(300000) function on_execute() for i = 1, 10 do log.info(text) end end");
    rig.activate().tick();
    REQUIRE(rig.log.size() == 4);
    CHECK(rig.log.back() == "warn: more than 1 MB of log in one execution: the rest is left out");
    rig.tick();
    CHECK(rig.log.size() == 8);
}

TEST_CASE("a full queue drops the oldest, counts it and warns once", "[lua][ports]") {
    ScriptRig rig(R"(
local from = input("from", "TimedLong", "", { queue = 2 })
local to = output("to", "TimedLong")
function on_execute() to:write(from:read()) end)");
    rig.activate();
    for (int round = 0; round < 3; ++round) {
        for (std::int32_t i = 1; i <= 4; ++i) rig.feed("from", i);
        rig.tick();
        CHECK(rig.out<std::int32_t>("to").read() == 3);
    }
    CHECK(rig.component->find_in_port("from")->dropped() > 2);
    REQUIRE(rig.log.size() == 1);
    CHECK(rig.log[0] == "warn: input 'from': its queue of 2 is full, the oldest message was dropped (said once)");
}

TEST_CASE("several writes in a tick: a queue gets each, the others the last", "[lua][ports]") {
    ScriptRig writer(R"(
local to = output("to", "TimedLong")
function on_execute() to:write(1) to:write(2) to:write(3) end)");
    InPort<std::int32_t> queue("queue", "", 5), latest("latest");
    queue.connect(*writer.component->find_out_port("to"));
    latest.connect(*writer.component->find_out_port("to"));
    writer.activate().tick();
    queue.latch(writer.now);
    latest.latch(writer.now);
    CHECK(queue.read() == 1);
    CHECK(queue.read() == 2);
    CHECK(queue.read() == 3);
    CHECK(latest.read() == 3);
    CHECK_FALSE(latest.is_new());
}

TEST_CASE("properties of an in-port tell of the message and of the connection", "[lua][ports]") {
    ScriptRig rig(R"(
local from = input("from", "TimedLong")
local out = output("out", "TimedString")
local function text()
  return ("%s %.2f %s %s %s"):format(from.is_new, from.tm, from.age, from.connected, from.stale)
end
function on_execute() out:write(text()) from:read() end)");
    rig.activate();
    auto& out = rig.out<std::string>("out");
    rig.tick();
    CHECK(out.read() == "false 0.00 inf false true");
    rig.tick(9);
    rig.feed("from", std::int32_t{5});
    rig.tick();
    CHECK(out.read() == "true 0.10 0.0 false false");
    OutPort<std::int32_t> source("source");
    rig.component->find_in_port("from")->connect(source);
    rig.tick();
    CHECK(out.read() == "false 0.10 0.01 true false");
    rig.tick(49);
    CHECK(out.read().substr(out.read().size() - 10) == "true false");  // 0.5 s are not yet more than 0.5 s
    rig.tick(1);
    CHECK(out.read().substr(out.read().size() - 9) == "true true");
    source.write(1);
    source.latch(rig.now);
    rig.tick(1);
    CHECK(out.read() == "true 0.62 0.0 true false");
}

TEST_CASE("with a queue the stamp is that of the message read last", "[lua][ports]") {
    ScriptRig rig(R"(
local from = input("from", "TimedLong", "", { queue = 5 })
local out = output("out", "TimedDoubleSeq")
local ticks = 0
function on_execute()
  ticks = ticks + 1
  if ticks == 6 then
    local a = from:read() local t = from.tm
    local b = from:read()
    out:write { a, t, b, from.tm }
  end
end)");
    rig.activate().tick(3);
    rig.feed("from", std::int32_t{1});
    rig.tick();
    rig.feed("from", std::int32_t{2});
    rig.tick(2);
    CHECK(rig.out<std::vector<double>>("out").read() == std::vector<double>{1, 0.03, 2, 0.04});
}

TEST_CASE("a value that does not fit names the file, the line, the port and the field", "[lua][ports]") {
    const std::string head =
        R"(local out = output("out", "TimedVelocity2D") local seq = output("seq", "TimedShortSeq") local short = output("short", "TimedShort") local pose = output("pose", "TimedPose2D"))";
    CHECK(failure_of(head, "out:write { vx = '1' }") ==
          "robot_controller.lua:3: output 'out' (TimedVelocity2D): field 'vx' expected a number, got string");
    CHECK(failure_of(head, "out:write { vz = 1 }") ==
          "robot_controller.lua:3: output 'out' (TimedVelocity2D): unknown field 'vz' (did you mean 'vx'?)");
    CHECK(failure_of(head, "pose:write { position = { x = true } }") ==
          "robot_controller.lua:3: output 'pose' (TimedPose2D): field 'position.x' expected a number, got boolean");
    CHECK(failure_of(head, "seq:write { 1, 2, 'x' }") ==
          "robot_controller.lua:3: output 'seq' (TimedShortSeq): element 3 expected an integer, got string");
    CHECK(failure_of(head, "short:write(40000)") ==
          "robot_controller.lua:3: output 'short' (TimedShort): expected an integer from -32768 to 32767, got 40000");
    CHECK(failure_of(head, "short:write()") ==
          "robot_controller.lua:3: output 'short' (TimedShort): expected an integer, got nil");
    CHECK(failure_of(head, "out:write { vx = 0/0 }") ==
          "robot_controller.lua:3: output 'out' (TimedVelocity2D): field 'vx' expected a finite number, got nan");
}

TEST_CASE("a caught write of a wrong value is no write", "[lua][ports]") {
    ScriptRig rig(R"(
local out = output("out", "TimedShort")
function on_execute() out:write(7) pcall(out.write, out, "x") end)");
    rig.activate().tick();
    CHECK(rig.status() == "ACTIVE");
    CHECK(rig.out<std::int16_t>("out").read() == 7);
}

TEST_CASE("an unknown property or method names the nearest", "[lua][ports]") {
    const std::string head = R"(local a = input("a", "TimedLong") local b = output("b", "TimedLong"))";
    CHECK(failure_of(head, "return a.is_nwe") ==
          "robot_controller.lua:3: input 'a' has no 'is_nwe' (did you mean 'is_new'?)");
    CHECK(failure_of(head, "a:raed()") == "robot_controller.lua:3: input 'a' has no 'raed' (did you mean 'read'?)");
    CHECK(failure_of(head, "a:write(1)") ==
          "robot_controller.lua:3: input 'a' has no 'write' (it has read, is_new, tm, age, connected, stale)");
    CHECK(failure_of(head, "b:read()") == "robot_controller.lua:3: output 'b' has no 'read' (it has write)");
    CHECK(failure_of(head, "for _, v in ipairs(a) do end") ==
          "robot_controller.lua:3: input 'a' is the port, not its value: read it first, with `:read()`");
    CHECK(failure_of(head, "a.value = 3") == "robot_controller.lua:3: input 'a': nothing of it can be set");
    CHECK(failure_of(head, "b.value = 3") ==
          "robot_controller.lua:3: output 'b': nothing of it can be set; write a value with `:write(value)`");
}

TEST_CASE("a method called with a dot gives a plain hint", "[lua][ports]") {
    const std::string head = R"(local a = input("a", "TimedLong") local b = output("b", "TimedLong"))";
    CHECK(failure_of(head, "a.read()") ==
          "robot_controller.lua:3: input 'a': write `:read(...)` with a colon, not `.read(...)`");
    CHECK(failure_of(head, "b.write(3)") ==
          "robot_controller.lua:3: output 'b': write `:write(...)` with a colon, not `.write(...)`");
    CHECK(failure_of(head, "a.read(b)") ==
          "robot_controller.lua:3: input 'a': write `:read(...)` with a colon, not `.read(...)`");
    CHECK(failure_of(head, "a.read({})") ==
          "robot_controller.lua:3: input 'a': write `:read(...)` with a colon, not `.read(...)`");
}

TEST_CASE("a port can't be tampered with", "[lua][ports]") {
    const std::string head = R"(local a = input("a", "TimedLong"))";
    CHECK(failure_of(head,
                     "assert(getmetatable(a) == false and type(a) == 'userdata' and not pcall(setmetatable, a, {}))") ==
          "");
    CHECK(failure_of(head, "assert(not pcall(rawset, a, 'read', 1) and not pcall(rawget, a, 'read'))") == "");
    CHECK(failure_of(head, "assert(tostring(a) == \"input 'a' (TimedLong)\")") == "");
    CHECK(failure_of(head, "return a + 1") ==
          "robot_controller.lua:3: attempt to perform arithmetic on a port value (upvalue 'a')");
}

TEST_CASE("ports can't be used while the file loads", "[lua][ports]") {
    CHECK(refusal("local a = input('a', 'TimedLong')\nprint(a:read())") ==
          "robot_controller.lua:2: input 'a': ports can't be read while the file loads");
    CHECK(refusal("local a = input('a', 'TimedLong')\nprint(a.is_new)") ==
          "robot_controller.lua:2: input 'a': ports can't be read while the file loads");
    CHECK(refusal("local a = output('a', 'TimedLong')\na:write(1)") ==
          "robot_controller.lua:2: output 'a': ports can't be written while the file loads");
}

TEST_CASE("options of ports are checked strictly", "[lua][ports]") {
    CHECK(refusal("input('a', 'TimedLong', '', { quue = 3 })") ==
          "robot_controller.lua:1: input 'a': unknown option 'quue' (did you mean 'queue'?)");
    CHECK(refusal("input('a', 'TimedLong', '', { safe = 3 })") ==
          "robot_controller.lua:1: input 'a': unknown option 'safe': expected queue");
    CHECK(refusal("input('a', 'TimedLong', '', { queue = 0 })") ==
          "robot_controller.lua:1: input 'a': option 'queue' expected a whole number from 1 to 100000, got 0");
    CHECK(refusal("input('a', 'TimedLong', '', { queue = 1.5 })") ==
          "robot_controller.lua:1: input 'a': option 'queue' expected a whole number from 1 to 100000, got 1.5");
    CHECK(refusal("input('a', 'TimedLong', '', 3)") ==
          "robot_controller.lua:1: input 'a': options expected a table, got number");
    CHECK(refusal("input('a', 'TimedLong', 3)") ==
          "robot_controller.lua:1: input 'a': its description expected a string, got number");
    CHECK(refusal("output('a', 'TimedVelocity2D', '', { safe = { vx = 'x' } })") ==
          "robot_controller.lua:1: output 'a': option 'safe' (TimedVelocity2D): field 'vx' expected a number, got "
          "string");
    CHECK(refusal("input('a', 'TimedLong', { queue = 3 })") == "");
    CHECK(refusal("input(nil, 'TimedLong')") == "robot_controller.lua:1: input: its name expected a string, got nil");
    CHECK(refusal("input('a')") ==
          "robot_controller.lua:1: input 'a': its type expected a string such as \"TimedVelocity2D\", got nil");
    CHECK(refusal("input('a', 'TimedShrtSeq')") ==
          "robot_controller.lua:1: input 'a': unknown type 'TimedShrtSeq' (did you mean 'TimedShortSeq'?); `nezumi "
          "types` lists them all");
}

TEST_CASE("outputs of velocities write zero once when their component leaves ACTIVE, others fall silent",
          "[lua][ports]") {
    ScriptRig rig(R"(
local vel = output("vel", "TimedVelocity2D")
local led = output("led", "TimedBoolean", "", { safe = false })
local hz = output("hz", "TimedShort")
function on_execute() vel:write { vx = 1 } led:write(true) hz:write(440) end)");
    rig.activate().tick(3);
    CHECK(rig.out<Velocity2D>("vel").read().vx == 1);
    REQUIRE(rig.component->deactivate(rig.now));
    rig.tick();
    CHECK(rig.out<Velocity2D>("vel").read() == Velocity2D{});
    CHECK(rig.out<bool>("led").read() == false);
    CHECK(rig.out<std::int16_t>("hz").read() == 440);
    CHECK(rig.out<std::int16_t>("hz").count() == 3);
    rig.tick(3);
    CHECK(rig.out<Velocity2D>("vel").count() == 4);
    CHECK(rig.out<bool>("led").count() == 4);
}

TEST_CASE("on_deactivated may write what the engine would otherwise write for it", "[lua][ports]") {
    ScriptRig rig(R"(
local vel = output("vel", "TimedVelocity2D")
function on_deactivated() vel:write { vx = 0.1 } end)");
    rig.activate().tick();
    REQUIRE(rig.component->deactivate(rig.now));
    rig.tick();
    CHECK(rig.out<Velocity2D>("vel").read().vx == 0.1);
    CHECK(rig.out<Velocity2D>("vel").count() == 1);
}

TEST_CASE("an execution that fails publishes nothing that it wrote", "[lua][ports]") {
    ScriptRig rig(R"(
local vel = output("vel", "TimedVelocity2D")
local hz = output("hz", "TimedShort")
local n = 0
function on_execute() n = n + 1 hz:write(n) vel:write { vx = n } if n == 3 then error("no more") end end)");
    rig.activate().tick(3);
    CHECK(rig.status() == "ERROR");
    CHECK(rig.error() == "robot_controller.lua:5: no more");
    CHECK(rig.out<std::int16_t>("hz").read() == 2);
    CHECK(rig.out<Velocity2D>("vel").read() == Velocity2D{});
    CHECK(rig.out<Velocity2D>("vel").count() == 3);
}

TEST_CASE("on_aborting and on_error may write, but no velocities", "[lua][ports]") {
    ScriptRig rig(R"(
local vel = output("vel", "TimedVelocity2D")
local hz = output("hz", "TimedShort")
function on_execute() error("stop") end
function on_aborting() hz:write(1) assert(not pcall(vel.write, vel, { vx = 1 })) end
function on_error() hz:write(2) vel:write { vx = 1 } end)");
    rig.activate().tick();
    CHECK(rig.out<std::int16_t>("hz").read() == 1);
    CHECK(rig.out<Velocity2D>("vel").read() == Velocity2D{});
    rig.tick();
    CHECK(rig.log.back() ==
          "error: on_error failed and is not called again before a reset: robot_controller.lua:6: output 'vel' "
          "(TimedVelocity2D): velocities can't be written in on_error: the robot is being stopped");
    CHECK(rig.error() == "robot_controller.lua:4: stop");
    CHECK(rig.out<Velocity2D>("vel").count() == 1);
}

TEST_CASE("pixels are a string in Lua", "[lua][ports]") {
    ScriptRig rig(R"(
local image = input("image", "CameraImage")
local out = output("out", "CameraImage")
function on_execute()
  local i = image:read()
  assert(type(i.pixels) == "string" and #i.pixels == 3 and i.pixels:byte(2) == 0)
  out:write { width = i.width, height = 1, bpp = 8, format = "gray8", pixels = i.pixels:reverse() }
end)");
    rig.activate();
    rig.feed("image", CameraImage{.width = 3, .height = 1, .pixels = {1, 0, 255}});
    rig.tick();
    CHECK(rig.out<CameraImage>("out").read().pixels == Octets{255, 0, 1});
}

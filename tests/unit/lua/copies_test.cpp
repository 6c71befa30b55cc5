// The tables that objects give are copies: writing to one is an error, all else is as with any table.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "engine/ports/messages.hpp"
#include "engine/tree/member.hpp"
#include "tests/unit/lua/objects_rig.hpp"

using namespace nezumi;

namespace {

// Something in each table that there is.
const std::string busy_behavior = counter_behavior + R"(
task("patrol", function()
  probe("flat", { 1, two = "x" })
  wait(1)
end)
)";

// Tries to write to a table and to all in it, and returns how many tables that were.
const std::string try_all = R"(
local function refused(path, table, key, step)
  for _, value in ipairs { 1, false } do
    local well, message = pcall(function() table[key] = value end)
    local says = ("can't set '%s%s': '%s' is a copy: "):format(path, step, path)
    assert(not well and message:find(says, 1, true), message or path .. step .. ' was set')
  end
end
function try(path, value)
  if type(value) ~= 'table' then return 0 end
  refused(path, value, 'zzz', '.zzz')
  refused(path, value, #value + 1, '[' .. #value + 1 .. ']')
  local count = 1
  for key, inner in pairs(value) do
    local step = type(key) == 'string' and '.' .. key or '[' .. key .. ']'
    refused(path, value, key, step)
    assert(rawequal(value[key], inner) and rawequal(rawget(value, key), inner), path .. step)
    count = count + try(path .. step, inner)
  end
  assert(not pcall(rawset, value, 1, 1) and not pcall(setmetatable, value, {}) and not getmetatable(value), path)
  return count
end
)";

struct Copies : Objective {
    explicit Copies(const std::string& behavior = busy_behavior, const std::string& more = "")
        : Objective(counter_system + more, {{"counter", behavior}}) {
        REQUIRE(run(try_all).empty());
        tick(3);
    }
    // How many tables a member is made of, none of which can be written.
    int tables_of(const std::string& path) {
        const std::string said = run(fmt::format("return try('{0}', {0})", path));
        INFO(said);
        REQUIRE(said.find_first_not_of("0123456789") == std::string::npos);
        return std::stoi(said);
    }
};

}  // namespace

TEST_CASE("tables of a component are read-only, and the error says what to do", "[lua][objects][copies]") {
    Copies it;
    std::string tables;
    for (const std::string owner : {"controller", "mouse"}) {
        for (const MemberInfo& member : component_members()) {
            if (member.name == "battery") continue;  // an error in simulation
            if (member.called || (member.robot && owner == "controller")) continue;
            if (it.tables_of(fmt::format("{}.{}", owner, member.name)) > 0 && owner == "mouse")
                tables += fmt::format("{} ", member.name);
        }
    }
    CHECK(tables == "commands leds limits probes said sets state tasks ");
    CHECK(it.tables_of("controller.state") == 3);
    CHECK(it.tables_of("controller.probes") == 3);
    CHECK(it.tables_of("controller.tasks") == 2);
    CHECK(it.tables_of("controller.config.gains") == 1);
    for (const std::string name : {"height", "pose", "tilt", "velocity"}) it.tables_of("mouse.truth." + name);
    CHECK(it.tables_of("mouse.truth.pose") == 2);
    CHECK(it.run("mouse.said[1] = 'x'") ==
          "box.lua:1: can't set 'mouse.said[1]': 'mouse.said' is a copy: send texts to the port of its speaker");
}

TEST_CASE("tables of a port are read-only, and the error says what to do", "[lua][objects][copies]") {
    Copies it;
    int tables = 0;
    for (const std::string port : {"controller.out", "mouse.ir_sensor_out"}) {
        for (const MemberInfo& member : port_members()) {
            if (!member.called) tables += it.tables_of(fmt::format("{}.{}", port, member.name));
        }
    }
    CHECK(tables == 6);
    CHECK(it.tables_of("mouse.current_pose_out.value") == 2);
    const std::string says =
        "is a copy: use controller.out:write(value), or controller.out:hold(value) to hold a value";
    CHECK(it.run("controller.ports.out.value.vx = 3") ==
          "box.lua:1: can't set 'controller.out.value.vx': 'controller.out.value' " + says);
    CHECK(it.run("controller.out.peers[1] = 'x'") ==
          "box.lua:1: can't set 'controller.out.peers[1]': 'controller.out.peers' is a copy: use connect and "
          "disconnect");
    CHECK_THAT(it.run("table.insert(mouse.ir_sensor_out.value, 3)"),
               Catch::Contains("can't set 'mouse.ir_sensor_out.value[5]'"));
    CHECK_THAT(it.run("table.sort(mouse.ir_sensor_out.value)"), Catch::Contains("is a copy"));
    CHECK_THAT(it.run("mouse.current_pose_out.value.position.x = 4"),
               Catch::Contains("'mouse.current_pose_out.value.position' is a copy: use "
                               "mouse.current_pose_out:write(value)"));
}

TEST_CASE("a port's value is a copy that can be written to a port", "[lua][objects][copies]") {
    std::string behavior = busy_behavior;
    for (const std::string_view type : compiled_message_names())
        behavior += fmt::format("output('of_{0}', '{0}')\n", type);
    Copies it(behavior);
    CHECK(it.run("controller.of_TimedShortSeq:write { 1, 2 } controller.of_SeenMarkerSeq:write { {}, { id = 7 } } "
                 "controller.of_RangeData:write { ranges = { 1, 2 }, geometry = { elements = { {}, {} } } }")
              .empty());
    it.tick();
    int tables = 0;
    for (const std::string_view type : compiled_message_names()) {
        CAPTURE(type);
        const std::string port = fmt::format("controller.of_{}", type);
        tables += it.tables_of(port + ".value");
        for (const std::string word : {"write", "hold"})
            CHECK(it.run(fmt::format("{0}:{1}({0}.value) {0}:release()", port, word)).empty());
        it.tick();
    }
    CHECK(tables > 30);
    CHECK(it.run("return #controller.of_RangeData.value.geometry.elements, controller.of_SeenMarkerSeq.value[2].id") ==
          "2 7");
}

TEST_CASE("a read-only copy is read like any table", "[lua][objects][copies]") {
    Copies it;
    REQUIRE(it.run("mouse.ir_sensor_out:hold { 3, 1, 2, 5 }").empty());
    it.tick();
    REQUIRE(it.run("seen = mouse.ir_sensor_out.value").empty());
    CHECK(it.run("local t = {} for i, v in ipairs(seen) do t[#t + 1] = i .. ':' .. v end return #t, t[4]") == "4 4:5");
    CHECK(it.run("local t = {} for k, v in pairs(seen) do t[#t + 1] = k .. ':' .. v end return #t, t[4]") == "4 4:5");
    CHECK(it.run("return #seen, rawlen(seen), next(seen), seen[5], rawget(seen, 2)") == "4 4 1 nil 1");
    CHECK(it.run("return table.concat(seen, ' '), table.unpack(seen)") == "3 1 2 5 3 1 2 5");
    CHECK(it.run("return select('#', table.unpack(seen)), math.max(table.unpack(seen)), type(seen)") == "4 5 table");
    CHECK(it.run("local own = table.move(seen, 1, #seen, 1, {}) table.sort(own) own[5] = 9 return "
                 "table.concat(own, ' ')") == "1 2 3 5 9");
    CHECK(it.run("return seen == seen, seen[1] > seen[2], seen == mouse.ir_sensor_out.value") == "true true false");
    CHECK(it.run("print(seen, mouse.current_pose_out.value)").empty());
    REQUIRE(it.box.printed.size() == 1);
    CHECK_THAT(it.box.printed[0], Catch::StartsWith("{ 3, 1, 2, 5 }"));
    CHECK(it.run("inject('controller.in', seen) hold(controller['in'], seen) release(controller['in'])").empty());
    CHECK(it.run("controller.config.gains = seen return #controller.config.gains") == "4");
    CHECK(it.run("return #select(2, controller:add(1, seen))") == "4");
    CHECK(it.run("mouse:teleport(mouse.current_pose_out.value)").empty());
    it.tick(2);
    CHECK(it.run("return table.concat(seen, ' ')") == "3 1 2 5");  // it stays what it was
}

TEST_CASE("a table that contains itself is read-only at every level", "[lua][objects][copies]") {
    Copies it("state.me = state\n" + busy_behavior);
    CHECK(it.run("return controller.state.me.me.count, rawequal(controller.state.me, controller.state)") == "0 false");
    CHECK(it.run("local state = controller.state return rawequal(state.me, state)") == "true");
    CHECK_THAT(it.run("controller.state.me.count = 1"), Catch::Contains("'controller.state' is a copy"));
}

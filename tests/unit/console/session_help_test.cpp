// What `help` says of all that a system has.
#include <catch2/catch.hpp>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("help explains components, ports, parameters and members", "[console][session]") {
    SessionRig it(counter_system, {{"counter",
                                    "--- Counts numbers,\n--- one by one.\n\n-- A remark.\nabout { version = "
                                    "'1.2' }" +
                                        counter_behavior}});
    CHECK_THAT(it.type("help(controller)"),
               StartsWith("controller  Counter, ACTIVE, version 1\n  Counts numbers,\n  one by one.\n  about version "
                          "1.2\n  in  in  TimedShortSeq  numbers\n  out out  TimedVelocity2D  velocity\n"
                          "  config.speed_x = 0.25  m/s, -1.5 to 1.5  straight-ahead speed\n  config.stop_d = 30\n") &&
                   Contains("\n  :add(...)  counts up\n  :fail(...)\n") &&
                   Contains(", status, tasks, type, use, version"));
    CHECK(it.type("help 'controller'") == it.type("help(controller)"));
    CHECK_THAT(it.type("help(controller.out)"), StartsWith("controller.out  out TimedVelocity2D: ") &&
                                                    Contains("\n  velocity\n  value.vx  m/s  ") && Contains(", tm, "));
    CHECK_THAT(it.type("help(mouse.current_pose_out)"),
               Contains("\n  value.position.x  m") && Contains("\n  value.heading  rad"));
    CHECK(it.type("help 'controller.ports.in'") == it.type("help(controller['in'])"));
    CHECK(it.type("help 'controller.config.speed_x'") ==
          "controller.config.speed_x = 0.25  m/s, -1.5 to 1.5  straight-ahead speed\n  its default is 0.25, which it "
          "follows");
    CHECK_THAT(it.type("controller.config.stop_d = 31 step(1) help 'controller.config.stop_d'"),
               Contains("stop_d = 31\n  its default is 30, and it was set"));
    CHECK(it.type("help(controller.config)") == it.type("print(controller.config)"));
    CHECK(it.type("help 'controller.status'") == "controller.status  \"INACTIVE\", \"ACTIVE\" or \"ERROR\"");
    CHECK(it.type("help 'mouse:teleport'") == "mouse:teleport(pose)  puts it at a pose, at rest");
    CHECK(it.type("help 'controller:add'") == "controller:add(...)  counts up");
    CHECK_THAT(it.type("help(mouse.truth)"), StartsWith("mouse.truth  what the simulation knows of it"));
    CHECK_THAT(it.type("help 'controller.truth'"), StartsWith("! help: controller has no 'truth'"));
    CHECK(it.type("help 'controller.statsu'") == "! help: controller has no 'statsu' (did you mean 'status'?)");
    CHECK(it.type("help 'mouse.truth.pos'") == "! help: mouse.truth has no 'pos' (did you mean 'pose'?)");
    CHECK(it.type("help 'mouse.truth.pose.positoin'") ==
          "! help: mouse.truth.pose has no 'positoin' (did you mean 'position'?)");
    CHECK(it.type("help 'mouse.truth.pose.position.x'") == it.type("help(mouse.truth)"));
    CHECK(it.type("help 'controller.out.vlue'") == "! help: controller.out has no 'vlue' (did you mean 'value'?)");
    CHECK(it.type("help 'controller.out.value.vz'") == "! help: controller.out has no 'vz' (did you mean 'vx'?)");
    CHECK(it.type("help 'controller.out.value.vx'") == it.type("help(controller.out)"));
    CHECK(it.type("help 'controller.config.sped_x'") ==
          "! help: controller has no parameter 'sped_x' (did you mean 'speed_x'?)");
    CHECK_THAT(it.type("help 'step'"), Contains("step(n)"));
    CHECK(it.type("help(step)") == it.type("help 'step'"));
    CHECK(it.type("help 'contrller'") == "! help: there is no word 'contrller' (did you mean 'controller'?)");
    CHECK(it.type("help(5)") ==
          "! help: expected a word, a component, a port or a name, as in help \"mouse.status\", got number");
}

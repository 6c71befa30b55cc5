// The CORBA calls of rtshell's tools and of RTSystemEditor, one after the other, on a running system.
#include <catch2/catch.hpp>
#include <chrono>
#include <string>
#include <thread>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/openrtm/names.hpp"

using namespace nezumi;

namespace {

// A run with a mouse, a controller and a manager, and the program that makes the tools' calls.
struct ToolRig {
    explicit ToolRig(const std::string& rtm = "manager = true")
        : run({"run",
               folder
                   .write("system.lua",
                          "robot \"mouse\" { model = \"raspimouse\" }\n"
                          "behavior \"controller\" { script = \"robot_controller\" }\n"
                          "rtm { export = { \"mouse\", \"controller\" }, nameserver = \"" +
                              names.address() + "\", " + rtm + " }\n")
                   .string(),
               "--headless"}),
          tool({fake_rtc(), names.address(), "Tool0", "in", "TimedVelocity2D", "in"}) {
        REQUIRE(tool.heard("ready") == "ready");
        REQUIRE(run.wait_for_error("rtm: controller is "));
    }
    std::string ask(const std::string& line, const std::string& begin) {
        tool.say(line);
        return tool.heard(begin);
    }

    Names names;
    Scratch folder;
    Program run;
    Peer tool;
};

}  // namespace

TEST_CASE("rtls, rtcat, rtcon, rtact, rtconf, rtprint, rtdis and rtexit work on a running system",
          "[cli][rtm][wallclock]") {
    ToolRig rig;
    REQUIRE(rig.run.wait_for_error("rtm: the manager is "));
    // rtls
    CHECK(rig.ask("names", "names") == "names Tool0.rtc controller0.rtc mouse0.rtc nezumi0.mgr");
    // rtcat
    CHECK(rig.ask("ports controller0", "ports ") ==
          "ports controller0 controller0.in DataInPort IDL:RTC/TimedShortSeq:1.0 controller0.out DataOutPort "
          "IDL:RTC/TimedVelocity2D:1.0");
    CHECK(rig.ask("state controller0", "state ") == "state 2");
    // rtconf
    CHECK(rig.ask("sets controller0", "sets ").starts_with("sets default | default speed_x=0 "));
    CHECK(rig.ask("set controller0 default speed_x 0.25", "done ") == "done 1");
    CHECK(rig.ask("use controller0 default", "done ") == "done 1");
    // rtcon and rtprint: an own port is connected, and reads
    CHECK(rig.ask("connect controller0 out dataflow_type=push", "connected ") == "connected 0");
    CHECK(rig.tool.heard("got ").ends_with("000000000000d03f00000000000000000000000000000000"));  // vx = 0.25
    CHECK(rig.ask("disconnect", "disconnected ") == "disconnected 0");
    // rtcon and rtdis between two components
    CHECK(rig.ask("link mouse0 ir_sensor_out controller0 in", "linked ") == "linked 0");
    CHECK(rig.ask("profiles controller0 in", "profiles") == "profiles made by a tool");
    CHECK(rig.ask("unlink controller0 in", "unlinked ") == "unlinked 0");
    // rtact, rtdeact
    CHECK(rig.ask("deactivate controller0", "done ") == "done 0");
    CHECK(rig.ask("state controller0", "state ") == "state 1");
    CHECK(rig.ask("activate controller0", "done ") == "done 0");
    CHECK(rig.ask("activate controller0", "done ") == "done 5");  // PRECONDITION_NOT_MET
    // rtexit
    CHECK(rig.ask("exit controller0", "exited ") == "exited 0");
    std::string left;
    for (int i = 0; i < 100 && left != "names Tool0.rtc mouse0.rtc nezumi0.mgr"; ++i) left = rig.ask("names", "names");
    CHECK(left == "names Tool0.rtc mouse0.rtc nezumi0.mgr");
}

TEST_CASE("rtmgr makes and ends behaviours of the project, and ends the run", "[cli][rtm][wallclock]") {
    ToolRig rig;
    REQUIRE(rig.run.wait_for_error("rtm: the manager is "));
    const auto manage = [&](const std::string& what, const std::string& begin) {
        return rig.ask("manager nezumi0 " + what, begin);
    };
    CHECK(manage("profile", "profile ") == "profile nezumi0 Lua master");
    CHECK(manage("components", "components ") == "components 2 mouse0 controller0");
    CHECK(manage("modules", "modules").find(" RobotController ") != std::string::npos);
    CHECK(manage("load robot_controller.lua", "loaded ") == "loaded 0");
    CHECK(manage("load unheard.so", "loaded ") == "loaded 2");  // BAD_PARAMETER
    CHECK(manage("create RobotController", "created ") == "created robot_controller0");
    CHECK(rig.ask("names", "names").find(" robot_controller0.rtc") != std::string::npos);  // at once
    CHECK(rig.ask("state robot_controller0", "state ") == "state 1");                      // INACTIVE
    CHECK(manage("create RobotController?instance_name=second0&conf.default.speed_x=0.5", "created ") ==
          "created second0");
    CHECK(rig.ask("sets second0", "sets ").starts_with("sets default | default speed_x=0.5 "));
    CHECK(manage("create RTC:Lab:Control:RobotController:1.0", "created ") == "created robot_controller_20");
    CHECK(manage("create Unheard", "created ") == "created nothing");
    CHECK(rig.run.wait_for_error("rtm: a tool can't add 'Unheard': there is no such behaviour"));
    CHECK(manage("create RobotController?instance_name=no-name", "created ") == "created nothing");
    CHECK(manage("delete second0", "deleted ") == "deleted 0");
    CHECK(manage("delete second0", "deleted ") == "deleted 2");
    CHECK(manage("shutdown", "shut down ") == "shut down 0");
    CHECK(rig.run.wait() == 0);
    CHECK(rig.run.error.find("rtm: a tool ends the run") != std::string::npos);
}

TEST_CASE("without manager = true, tools find no manager", "[cli][rtm][wallclock]") {
    ToolRig rig("manager = false");
    CHECK(rig.ask("names", "names") == "names Tool0.rtc controller0.rtc mouse0.rtc");
}

TEST_CASE("each of several name services is watched for itself", "[cli][rtm][wallclock]") {
    Names first, second;
    Scratch folder;
    Program run({"run",
                 folder
                     .write("system.lua",
                            "robot \"mouse\" { model = \"raspimouse\" }\nrtm { export = \"mouse\", "
                            "nameserver = { \"" +
                                first.address() + "\", \"" + second.address() +
                                "\" } }\n"
                                "connect(\"rtm:Out0.out\", \"mouse.target_velocity_in\")\n")
                     .string(),
                 "--headless"});
    // Both have the mouse, and an RTC of the second is found.
    Peer here({fake_rtc(), first.address(), "Tool0", "in", "TimedVelocity2D", "in"});
    REQUIRE(here.heard("ready") == "ready");
    Peer there({fake_rtc(), second.address(), "Out0", "out", "TimedVelocity2D", "out"});
    REQUIRE(there.heard("ready") == "ready");
    REQUIRE(run.wait_for_error("connected: rtm:Out0.out to mouse.target_velocity_in"));
    here.say("state mouse0");
    CHECK(here.heard("state ") == "state 2");
    there.say("state mouse0");
    CHECK(there.heard("state ") == "state 2");
    // One that is away is said, and comes back; the other one works meanwhile.
    first.kill();
    first.forget();
    REQUIRE(run.wait_for_error("rtm: no name service answers at " + first.address()));
    there.say("state mouse0");
    CHECK(there.heard("state ") == "state 2");
    first.start();
    Peer again({fake_rtc(), first.address(), "Tool1", "in", "TimedVelocity2D", "in"});
    REQUIRE(again.heard("ready") == "ready");
    std::string names;
    for (int i = 0; i < 200 && names != "names Tool1.rtc mouse0.rtc"; ++i) {
        again.say("names");
        names = again.heard("names");
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    CHECK(names == "names Tool1.rtc mouse0.rtc");
}

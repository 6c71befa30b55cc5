// The console's words for components of other programs.
#include <catch2/catch.hpp>

#include "bindings/console/save_system.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;
using Catch::Matchers::Contains;

namespace {

// Answers as soon as it is told to.
struct Asked {
    std::vector<PeerRequest> requests;
    std::optional<std::promise<Expected<std::string>>> late{};
    Expected<std::string> says = "rtm:Out0  Out, ACTIVE";
    bool hangs = false;

    SessionOptions options() {
        SessionOptions options;
        options.peers = [this](const PeerRequest& request) {
            requests.push_back(request);
            late.emplace();
            auto answer = late->get_future();
            if (!hangs) late->set_value(says);
            return answer;
        };
        return options;
    }
};

const std::map<std::string, std::string> behaviors{{"counter", counter_behavior}};

}  // namespace

TEST_CASE("RTCs are listed, shown and changed by their names", "[console][rtm]") {
    Asked asked;
    SessionRig it(counter_system, behaviors, asked.options());
    const auto request = [&](const std::string& text) {
        CHECK(it.type(text) == "rtm:Out0  Out, ACTIVE");
        return asked.requests.back();
    };
    CHECK(request("ls 'rtm:'").name.empty());
    CHECK(request("rtm()").name.empty());
    CHECK(request("ls 'rtm:pc.host_cxt/Out0'").name == "pc.host_cxt/Out0");
    CHECK(request("rtm 'Out0'").what == PeerRequest::What::look);
    CHECK(request("activate 'rtm:Out0'").what == PeerRequest::What::activate);
    CHECK(request("deactivate 'rtm:Out0'").what == PeerRequest::What::deactivate);
    CHECK(request("rtm('rtm:Out0', 'activate')").what == PeerRequest::What::activate);
    CHECK(asked.requests.back().name == "Out0");
    CHECK(request("rtm('Out0', 'reset')").what == PeerRequest::What::reset);
    CHECK(request("rtm('Out0', 'use', 'fast')").set == "fast");
    CHECK(request("rtm('Out0', { speed = 0.5, on = true, gains = { 1, 2 } })").values ==
          ParameterValues{{"speed", 0.5}, {"on", true}, {"gains", std::vector<std::int64_t>{1, 2}}});
    CHECK(asked.requests.back().what == PeerRequest::What::configure);
}

TEST_CASE("a wrong request to an RTC is refused", "[console][rtm]") {
    Asked asked;
    SessionRig it(counter_system, behaviors, asked.options());
    CHECK(it.type("rtm(5)") == "! rtm: expected an RTC's name, as in rtm \"ConsoleOut0\", got number");
    CHECK(it.type("rtm('Out0', 'activat')") == "! rtm: there is no 'activat' (did you mean 'activate'?)");
    CHECK(it.type("rtm('Out0', 'dance')") ==
          "! rtm: there is no 'dance' (there are activate, deactivate, reset, use, exit, forget)");
    CHECK(it.type("rtm('rtm:', 'reset')") == "! rtm: expected the name of an RTC: rtm() lists them");
    CHECK(it.type("rtm('Out0', 5)") ==
          "! rtm: expected an action, as in rtm(\"ConsoleOut0\", \"activate\"), or a table of values");
    CHECK(it.type("rtm('Out0', {})") == "! rtm: expected values by name, as in rtm(\"ConsoleOut0\", { speed = 0.5 })");
    CHECK(it.type("rtm('Out0', 'use')") ==
          "! rtm: expected the name of a set, as in rtm(\"ConsoleOut0\", \"use\", \"default\"), got nothing");
    CHECK(asked.requests.empty());
    asked.says = failure("there is no RTC 'Out0' in the name service");
    CHECK(it.type("rtm 'Out0'") == "! rtm: there is no RTC 'Out0' in the name service");
    SessionRig without;
    CHECK(without.type("ls 'rtm:'") == "! ls: this program can't reach RTCs: use `nezumi run`");
}

TEST_CASE("ticks go on while an RTC is waited for, and the wait can be interrupted", "[console][rtm]") {
    Asked asked;
    asked.hangs = true;
    SessionRig it(counter_system, behaviors, asked.options());
    it.session->submit("ls 'rtm:'");
    while (asked.requests.empty()) it.session->advance();
    const auto before = it.live->system().now().tick;
    for (int i = 0; i < 5; ++i) {
        it.session->advance();
        it.turn();
    }
    CHECK(it.live->system().now().tick == before + 5);
    CHECK(it.session->is_busy());
    CHECK(asked.requests.size() == 1);
    SECTION("until it answers") {
        asked.late->set_value("there");
        while (it.session->is_busy()) it.session->advance();
        CHECK(it.shown == "there");
    }
    SECTION("or Ctrl-C comes") {
        it.session->interrupt();
        CHECK_FALSE(it.session->is_busy());
        asked.hangs = false;
        CHECK(it.type("ls 'rtm:'") == "rtm:Out0  Out, ACTIVE");
    }
}

TEST_CASE("connections to RTCs are made at the console, shown and saved", "[console][rtm]") {
    SessionRig it(counter_system + "rtm { export = \"controller\" }\n");
    CHECK(it.type("connect('rtm:Out0.out', controller.ports['in'])") == "");
    CHECK(it.type("connect('controller.out', 'rtm:pc.host_cxt/Mouse0.target_velocity_in')") == "");
    CHECK_THAT(it.type("ls(controller)"), Contains("<- mouse.ir_sensor_out, rtm:Out0.out") &&
                                              Contains("rtm:pc.host_cxt/Mouse0.target_velocity_in"));
    CHECK(it.type("controller.out.peers[2]") == "\"rtm:pc.host_cxt/Mouse0.target_velocity_in\"");
    CHECK(it.type("connect('rtm:Out0.out', 'controller.out')") ==
          "! connect: controller.out is an out-port: connect goes from an out-port to an in-port");
    const auto saved = present_system(*it.live)->spec.connections;
    REQUIRE(saved.size() == 4);
    CHECK(saved[2] == ConnectionSpec{"rtm:Out0.out", "controller.in", {}});
    CHECK_THAT(it.type("save '" + it.folder.path("saved.lua").string() + "'"),
               Contains(": 2 components, 4 connections"));
    CHECK(it.type("disconnect('rtm:Out0.out', 'controller.in')") == "");
    CHECK(it.type("disconnect(controller.out)") == "");
    CHECK(present_system(*it.live)->spec.connections ==
          std::vector<ConnectionSpec>{{"mouse.ir_sensor_out", "controller.in", {}}});
    CHECK(it.type("disconnect('rtm:Out0.out')") == "! disconnect: rtm:Out0.out is not connected");
}

TEST_CASE("removing a component removes its connections to RTCs", "[console][rtm]") {
    SessionRig it(counter_system + "rtm { export = \"controller\" }\nconnect(\"rtm:Out0.out\", \"controller.in\")\n");
    CHECK_THAT(it.type("remove 'controller'"),
               Contains("controller.in is no longer connected to mouse.ir_sensor_out, rtm:Out0.out"));
    CHECK(present_system(*it.live)->spec.connections.empty());
}

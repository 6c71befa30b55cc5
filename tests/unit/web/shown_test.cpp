// What a browser is shown besides changing numbers: earlier log lines, the floor, markers, changes by hand.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>

#include "engine/base/whole_file.hpp"
#include "engine/values/cdr.hpp"
#include "engine/values/value_text.hpp"
#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

using Json = WebRig::Json;

Json next_system(RawBrowser& browser, std::string_view with = "") {
    for (;;) {
        const std::string text = browser.next_text("\"is\":\"system\"");
        REQUIRE_FALSE(text.empty());
        if (text.find(with) != std::string::npos) return Json::parse(text);
    }
}

// The next message of this kind, without its four bytes for the kind.
std::string next_binary(RawBrowser& browser, char kind) {
    for (;;) {
        const auto got = browser.next();
        REQUIRE(got);
        if (got->opcode == 2 && got->bytes[0] == kind) return got->bytes.substr(4);
    }
}

}  // namespace

TEST_CASE("a new browser gets the latest lines of the log, each once", "[web]") {
    const WebRig rig;
    Hub hub(AccessControl(), StaticFiles(""), rig.live->part_reader(), "}");
    for (std::size_t i = 0; i < Hub::most_kept + 5; ++i) hub.log("line " + std::to_string(i));
    hub.opened(1, {});
    hub.log("the last");
    CHECK(hub.next(1)->bytes.find("hello") != std::string::npos);
    for (std::size_t i = 5; i < Hub::most_kept + 5; ++i) CHECK(hub.next(1)->bytes == "line " + std::to_string(i));
    CHECK(hub.next(1)->bytes == "the last");
    CHECK_FALSE(hub.next(1));
}

TEST_CASE("the size of stored log lines is limited", "[web]") {
    const WebRig rig;
    Hub hub(AccessControl(), StaticFiles(""), rig.live->part_reader(), "}");
    for (int i = 0; i < 10; ++i) hub.log(std::string(Hub::longest_kept / 2, 'x'));
    hub.opened(1, {});
    CHECK(hub.next(1)->bytes.find("hello") != std::string::npos);
    int lines = 0;
    while (hub.next(1)) ++lines;
    CHECK(lines == 2);
}

TEST_CASE("a browser that connects while the run ends gets the last message and is closed", "[web]") {
    const WebRig rig;
    Hub hub(AccessControl(), StaticFiles(""), rig.live->part_reader(), "}");
    hub.end("goodbye");
    hub.opened(1, {});
    CHECK(hub.next(1)->bytes.find("hello") != std::string::npos);
    CHECK(hub.next(1)->bytes == "goodbye");
    CHECK(hub.next(1)->closes);
}

TEST_CASE("the picture of the floor is sent as its file on request", "[web]") {
    WebRig rig(R"(
arena { size = { 2, 1 }, floor { image = ")" +
                   source_root() + "/behaviors/line.png" + R"(", size = { 2, 1 } } }
robot "mouse" { model = "raspimouse" }
)",
               {});
    RawBrowser browser = rig.open(rig.view_token);
    const auto system = next_system(browser);
    CHECK(system["arena"]["floor"]["file"] == "line.png");
    CHECK(system["arena"]["floor"]["size"] == Json{2, 1});
    REQUIRE(browser.send_frame(R"({"do":"floor"})"));
    const std::string bytes = next_binary(browser, 3);
    CHECK(bytes == *read_whole(source_root() + "/behaviors/line.png", "", Hub::largest_floor));
}

TEST_CASE("a request for the floor's picture without one gets none", "[web]") {
    const WebRig rig;
    Hub hub(AccessControl(), StaticFiles(""), rig.live->part_reader(), "}");
    hub.opened(1, {});
    CHECK(hub.next(1));
    hub.show(Hub::Slot::system, "the system");
    CHECK(hub.next(1)->bytes == "the system");
    CHECK(hub.received(1, R"({"do":"floor"})"));
    CHECK_FALSE(hub.next(1));
    hub.show_floor(rig.folder.path("gone.png").string());
    CHECK(hub.received(1, R"({"do":"floor"})"));
    CHECK(hub.next(1)->bytes.find("the floor's picture can't be shown") != std::string::npos);
    CHECK_FALSE(hub.next(1));
}

TEST_CASE("a marker is sent with the cells of its tag", "[web]") {
    WebRig rig(
        R"(arena { marker { name = "seven", id = 7, at = { 0, 0, 0.1 } }, marker { name = "eight", id = 8, at = { 1, 0, 0.1 } } })",
        {});
    RawBrowser browser = rig.open();
    const auto markers = next_system(browser)["markers"];
    REQUIRE(markers.size() == 2);
    const auto rows = markers[0]["modules"].get<std::vector<std::string>>();
    REQUIRE(rows.size() == 8);
    CHECK(rows.front() == "00000000");
    CHECK(rows.back() == "00000000");
    for (const std::string& row : rows) {
        CHECK(row.size() == 8);
        CHECK(row.front() == '0');
        CHECK(row.back() == '0');
    }
    CHECK(markers[0]["modules"] != markers[1]["modules"]);
}

TEST_CASE("a parameter is marked as changed after a change by hand, with the value before", "[web]") {
    WebRig rig(R"(
robot    "mouse"      { model = "raspimouse" }
behavior "controller" { script = "counter", config = { speed_x = 1 }, sets = { fast = { stop_d = 40 } } }
)");
    RawBrowser browser = rig.open();
    const auto parameter = [](const Json& system, std::size_t index) {
        return system["components"][1]["parameters"][index];
    };
    const auto first = next_system(browser);
    CHECK(parameter(first, 0)["value"] == 1.0);
    CHECK(parameter(first, 0)["default"] == 0.25);
    CHECK(parameter(first, 0)["given"] == 1.0);
    CHECK(parameter(first, 0)["changed"] == false);

    REQUIRE(rig.live->act(SetParameter{"controller", "speed_x", 0.25}, {}));
    rig.tick();
    const auto changed = next_system(browser, "\"changed\":true");
    CHECK(parameter(changed, 0)["changed"] == true);
    CHECK(parameter(changed, 1)["changed"] == false);

    REQUIRE(rig.live->act(Use{"controller", "fast"}, {}));
    rig.tick();
    const auto of_set = next_system(browser, "\"set\":\"fast\"");
    CHECK(parameter(of_set, 0)["changed"] == false);
    CHECK(parameter(of_set, 1)["given"] == 40);
    CHECK(parameter(of_set, 1)["changed"] == false);
}

TEST_CASE("a browser gets the numbers of a robot's truth, a behaviour's probes and its state", "[web]") {
    const std::string probing = R"lua(
local out = output("out", "TimedVelocity2D", "")
state.steps = 0
state.name = "no number"
function on_execute()
  state.steps = state.steps + 1
  probe("error", state.steps * 0.5)
  out:write { vx = 0.1 }
end
)lua";
    WebRig rig(R"(
robot    "mouse"   { model = "raspimouse" }
behavior "probing" { script = "probing" }
connect("probing.out", "mouse.target_velocity_in")
)",
               {{"probing", probing}});
    rig.paused = false;
    RawBrowser browser = rig.open();
    REQUIRE(browser.send_frame(
        R"({"do":"watch","members":["mouse.truth","mouse.collided","probing.probes","probing.state","probing.out","nobody.truth","x"]})"));
    std::map<std::string, std::map<std::string, double>> seen;
    while (seen.size() < 4 || !(seen["mouse.truth"]["pose.position.x"] > 0)) {
        const std::string bytes = next_binary(browser, 1);
        WebFrame frame;
        REQUIRE(read_cdr(Octets(bytes.begin(), bytes.end()), {}, frame));
        for (const WebMember& member : frame.members) {
            if (member.name == "nobody.truth") continue;
            for (const WebLeaf& leaf : member.leaves) seen[member.name][leaf.name] = leaf.value;
        }
    }
    CHECK(seen.size() == 4);
    CHECK(seen["mouse.collided"][""] == 0);
    CHECK(seen["probing.state"]["steps"] >= 1);
    CHECK_FALSE(seen["probing.state"].contains("name"));
    CHECK(seen["probing.probes"]["error"] == 0.5 * seen["probing.state"]["steps"]);
}

TEST_CASE("an execution is explained to any browser, also a view-only one", "[web][explain]") {
    WebRig rig;
    rig.paused = false;
    RawBrowser browser = rig.open(rig.view_token);
    CHECK(WebRig::answer(browser, {{"do", "explain"}, {"id", 1}, {"component", "controller"}})["ok"] == true);
    const auto seen = Json::parse(browser.next_text("\"is\":\"explain\""));
    CHECK(seen["component"] == "controller");
    CHECK(seen["inputs"][0]["peers"] == Json{"mouse.ir_sensor_out"});
    CHECK_FALSE(seen["lines"].empty());
    CHECK(seen["robots"][0]["robot"] == "mouse");
    CHECK(seen["robots"][0]["wheels"].is_object());
    const auto refused = WebRig::answer(browser, {{"do", "explain"}, {"id", 2}, {"component", "mouse"}});
    CHECK(refused["ok"] == false);
    CHECK(refused["text"] == "mouse is not a behaviour: it has no lines");
}

TEST_CASE(
    "a behaviour that has not been executed yet is explained after its first execution, and a browser sees that time "
    "is paused",
    "[web][explain]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    REQUIRE(browser.send_frame(Json{{"do", "explain"}, {"id", 1}, {"component", "controller"}}.dump()));
    CHECK(Json::parse(browser.next_text("\"is\":\"explain\""))["waits"] == true);
    SECTION("and then it is gone") {
        REQUIRE(rig.live->act(Remove{"controller"}, {}));
        CHECK(browser.next_text("\"is\":\"explain\"").find("controller is gone: not explained") != std::string::npos);
    }
    SECTION("and then it is executed") {
        rig.turn();
        CHECK(Json::parse(browser.next_text("\"is\":\"explain\""))["tick"] == 0);
    }
}

TEST_CASE("while time is paused, the last execution is explained", "[web][explain]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    int id = 0;
    const auto explained = [&] {
        REQUIRE(WebRig::answer(browser, {{"do", "explain"}, {"id", ++id}, {"component", "controller"}})["ok"] == true);
        return Json::parse(browser.next_text("\"is\":\"explain\""));
    };
    rig.turn(10);
    const std::uint64_t hash = rig.live->trace_hash();
    const Json seen = explained();
    CHECK(seen["tick"] == 9);
    CHECK_FALSE(seen["lines"].empty());
    CHECK(seen["outputs"][0]["value"] == short_text((*rig.live->system().port("controller.out"))->value()));
    CHECK(rig.live->system().now().tick == 10);
    CHECK(rig.live->trace_hash() == hash);
    rig.turn();
    CHECK(explained()["tick"] == 10);
    rig.turn(3);
    CHECK(explained()["tick"] == 13);
    REQUIRE(rig.live->act(Seek{.tick = 5}, {}));
    CHECK(explained()["tick"] == 4);
}

TEST_CASE("of a behaviour in ERROR the execution that failed is explained", "[web][explain]") {
    WebRig rig("behavior 'it' { script = 'it' }\n", {{"it",
                                                      "local turns = 0\nfunction on_execute()\n  turns = turns + 1\n"
                                                      "  if turns == 4 then error('enough') end\nend\n"}});
    rig.turn(20);
    rig.paused = false;
    RawBrowser browser = rig.open();
    CHECK(WebRig::answer(browser, {{"do", "explain"}, {"id", 1}, {"component", "it"}})["ok"] == true);
    const auto seen = Json::parse(browser.next_text("\"is\":\"explain\""));
    CHECK(seen["tick"] == 3);
    CHECK(seen["lines"].back()["line"] == 4);
}

TEST_CASE("a browser sees the functions of a failed behaviour with their variables", "[web]") {
    WebRig rig("behavior 'it' { script = 'it' }\n",
               {{"it",
                 "local function half(of)\n  return of.x / 2\nend\nfunction on_execute()\n  local y = half(7)\n"
                 "  return y\nend\n"}});
    rig.turn(2);
    RawBrowser browser = rig.open();
    const Json component = next_system(browser)["components"][0];
    CHECK(component["error"].get<std::string>().find("it.lua:2: ") != std::string::npos);
    REQUIRE(component["frames"].size() == 2);
    CHECK(component["frames"][0]["line"] == 2);
    CHECK(component["frames"][0]["name"] == "half");
    CHECK(component["frames"][0]["locals"] == Json::array({Json::array({"of", "7"})}));
    CHECK(component["frames"][1]["line"] == 5);
}

TEST_CASE("a browser is shown the values of a time that is remembered", "[web][past]") {
    WebRig rig("behavior 'controller' { script = 'counter' }\n", {{"counter", R"(
local out = output("out", "TimedVelocity2D")
local label = output("label", "TimedString")
state.steps = 0
function on_execute()
  state.steps = state.steps + 1
  out:write { vx = now() }
  label:write("tick " .. math.floor(now() * 100 + 0.5) // 10)
end
)"}});
    rig.live->trace().remember_ports();
    rig.turn(50);
    RawBrowser browser = rig.open(rig.view_token);
    int id = 0;
    const auto then = [&](double at) {
        REQUIRE(browser.send_frame(Json{
            {"do", "then"}, {"id", ++id}, {"at", at}, {"names", {"controller.out", "controller.label", "nobody.out"}}}
                                       .dump()));
        return Json::parse(browser.next_text("\"is\":\"then\""))["values"];
    };
    const Json values = then(0.3);
    CHECK(values.size() == 2);
    CHECK(values["controller.out"]["tm"] == 0.29);
    CHECK(values["controller.out"]["leaves"][0] == Json::array({"vx", 0.29}));
    CHECK(values["controller.label"]["leaves"] == Json::array({Json::array({"", "tick 2"})}));
    CHECK(then(0).empty());
    CHECK(rig.live->system().now().tick == 50);
}

TEST_CASE("a browser is shown values that are no longer remembered, computed again beside the run", "[web][past]") {
    WebRig rig("behavior 'controller' { script = 'counter' }\n", {{"counter", R"(
local out = output("out", "TimedVelocity2D")
state.steps = 0
function on_execute()
  state.steps = state.steps + 1
  out:write { vx = now() }
end
)"}});
    rig.live->trace().keep(20);
    rig.live->trace().remember_ports();
    rig.turn(100);
    rig.pause();
    const std::uint64_t hash = rig.live->trace_hash();
    RawBrowser browser = rig.open(rig.view_token);
    SECTION("at a time of the slider: what is remembered at once, and then the rest") {
        const Json names{"controller.out", "controller.state"};
        REQUIRE(browser.send_frame(Json{{"do", "then"}, {"id", 1}, {"at", 0.3}, {"names", names}}.dump()));
        CHECK(Json::parse(browser.next_text("\"is\":\"then\""))["values"].empty());
        const Json then = Json::parse(browser.next_text("\"is\":\"then\""));
        CHECK(then["at"] == 0.3);
        CHECK(then["values"]["controller.out"]["leaves"][0] == Json::array({"vx", 0.29}));
        CHECK(then["values"]["controller.state"]["leaves"] == Json::array({Json::array({"steps", 30.0})}));
        // A later time and one before go on from there, and so does what is remembered.
        for (const double at : {0.5, 0.1, 0.95}) {
            REQUIRE(browser.send_frame(Json{{"do", "then"}, {"id", 2}, {"at", at}, {"names", names}}.dump()));
            static_cast<void>(browser.next_text("\"is\":\"then\""));
            const Json again = Json::parse(browser.next_text("\"is\":\"then\""));
            CHECK(again["values"]["controller.state"]["leaves"][0][1] == std::round(at * 100));
        }
    }
    SECTION("for a plot, from the start") {
        CHECK(WebRig::answer(browser, Json{{"do", "earlier"}, {"id", 1}, {"port", "controller.out"}})["ok"] == true);
        REQUIRE(browser.send_frame(Json{{"do", "earlier"}, {"id", 2}, {"port", "controller.out"}}.dump()));
        const Json earlier = Json::parse(browser.next_text("\"is\":\"earlier\""));
        CHECK(earlier["port"] == "controller.out");
        CHECK(earlier["values"].front() == Json::array({0.0, 0.0, 0.0, 0.0}));
        CHECK(earlier["values"].back()[0] == 0.99);
        CHECK(WebRig::answer(browser, Json{{"do", "earlier"}, {"id", 3}, {"port", "nobody.out"}})["ok"] == false);
    }
    CHECK(rig.live->trace_hash() == hash);
}

TEST_CASE("a browser with full access gets the view-only token", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    CHECK(Json::parse(browser.next_text("hello"))["view_token"] == rig.view_token);
}

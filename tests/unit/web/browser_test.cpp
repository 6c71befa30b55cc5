// What a browser is shown of a running system, and its actions on it.
#include <catch2/catch.hpp>

#include "engine/values/cdr.hpp"
#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

using Json = WebRig::Json;

const Json velocity{{"TimedVelocity2D", {{"vx", 0.1}, {"vy", 0}, {"va", 0}}}};

const std::string driven_by_1 = R"("drivers":{"mouse.target_velocity_in":"browser 1"})";

Json drive_message(bool take) {
    return {{"do", "drive"}, {"port", "mouse.target_velocity_in"}, {"value", velocity}, {"take", take}};
}

// The next frame; skips texts.
WebFrame next_frame(RawBrowser& browser) {
    for (;;) {
        const auto got = browser.next();
        REQUIRE(got);
        if (got->opcode != 2) continue;
        REQUIRE(got->bytes.size() > 4);
        REQUIRE(got->bytes.substr(0, 4) == std::string("\1\0\0\0", 4));
        const Octets bytes(got->bytes.begin() + 4, got->bytes.end());
        WebFrame frame;
        const auto read = read_cdr(bytes, {}, frame);
        REQUIRE(read);
        return frame;
    }
}

// Whether the engine soon notices that the first browser has disconnected.
bool has_gone(WebRig& rig) {
    for (int rounds = 0; rounds < 5000 && !rig.said("browser 1: has disconnected"); ++rounds) {
        rig.serve();
        usleep(1000);
    }
    return rig.said("browser 1: has disconnected");
}

}  // namespace

TEST_CASE("a browser gets the types that files of the system define", "[web][messages]") {
    WebRig rig("behavior 'seer' { script = 'seer' }\n",
               {{"seer", "output('seen', 'Obstacle', '') output('where', 'Corner', '')"},
                {"messages/corner", "return message 'Corner' { { 'x', 'float' } }"},
                {"messages/obstacle",
                 "return message 'Obstacle' { { 'colour', { 'red', 'green' } }, { 'corners', 'Corner[]' }, "
                 "{ 'size', 'double[3]', unit = 'm' } }"}});
    RawBrowser browser = rig.open();
    const auto types = Json::parse(browser.next_text("\"is\":\"system\""))["types"];
    CHECK(types["Obstacle"][0]["name"] == "tm");
    CHECK(types["Obstacle"][1]["type"] == "enum<red,green>");
    CHECK(types["Obstacle"][2]["type"] == "sequence<payload Corner>");
    CHECK(types["Obstacle"][3]["type"] == "array<double,3>");
    CHECK(types["Obstacle"][3]["unit"] == "m");
    CHECK(types["Corner"][0]["name"] == "tm");
    CHECK(types["payload Corner"][0]["name"] == "x");
}

TEST_CASE("a browser gets the system, its types and all poses", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto hello = Json::parse(browser.next_text("hello"));
    CHECK(hello["callbacks"] == hook_names());
    CHECK(hello["types"]["TimedVelocity2D"][0]["type"] == "Time");
    CHECK(hello["types"]["TimedVelocity2D"][1]["type"] == "Velocity2D");
    CHECK(hello["types"]["Velocity2D"][2]["name"] == "va");
    CHECK(hello["types"]["Velocity2D"][2]["unit"] == "rad/s");
    CHECK(hello["types"]["TimedShortSeq"][1]["type"] == "sequence<int16>");
    CHECK(hello["types"]["RangeData"][1]["name"] == "ranges");
    CHECK(hello["types"]["WebFrame"][5]["type"] == "sequence<WebRobot>");
    CHECK(hello["types"]["WebPort"][2]["type"] == "sequence<uint8>");

    const auto system = Json::parse(browser.next_text("\"is\":\"system\""));
    CHECK(system["components"][1]["name"] == "controller");
    CHECK(system["components"][1]["kind"] == "behavior");
    CHECK(system["components"][1]["state"] == "ACTIVE");
    CHECK(system["components"][1]["parameters"][0]["value"] == 0.25);
    CHECK(system["components"][1]["parameters"][0]["min"] == -1.5);
    CHECK(system["components"][1]["sets"] == Json{"fast", "slow"});
    CHECK(system["connections"][0]["from"] == "mouse.ir_sensor_out");
    CHECK(system["robots"][0]["name"] == "mouse");
    REQUIRE(system["arena"]["things"].size() >= 1);
    CHECK(system["arena"]["things"][0]["place"]["line"] > 0);
    CHECK(system["drivers"].empty());
    CHECK(system["hosts"].empty());

    rig.paused = false;
    REQUIRE(browser.send_frame(R"({"do":"watch","ports":["controller.out","nobody.out"],"truth":true,"rays":true})"));
    WebFrame frame = next_frame(browser);
    while (frame.robots.empty()) frame = next_frame(browser);
    CHECK(frame.robots[0].is_truth);
    CHECK_FALSE(frame.rays.empty());
    while (frame.ports.empty() || frame.ports[0].count == 0) frame = next_frame(browser);  // until the first tick
    CHECK(frame.ports[0].index == 0);
    Velocity2D sent;
    double tm = 0;
    REQUIRE(read_cdr_message(frame.ports[0].payload, sent, tm));
    CHECK(sent.vx == 0.25);
    CHECK(frame.running);
}

TEST_CASE("an act has the browser as its actor, is logged and is answered", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const Json set{{"do", "act"},
                   {"id", 7},
                   {"act", "SetParameter"},
                   {"fields", {{"component", "controller"}, {"parameter", "speed_x"}, {"value", 0.5}}}};
    CHECK(WebRig::answer(browser, set)["ok"] == true);
    rig.tick();
    CHECK(rig.component("controller").parameters().find("speed_x")->value.get<double>() == 0.5);
    CHECK(rig.said("browser 1: set parameter controller, speed_x, 0.5"));
    Json wrong = set;
    wrong["fields"]["value"] = 5.0;
    const auto refused = WebRig::answer(browser, wrong);
    CHECK(refused["ok"] == false);
    CHECK(refused["text"] == "parameter 'speed_x' (number): 5.0 is above its maximum 1.5");

    const Json hold{{"do", "act"},
                    {"id", 8},
                    {"act", "Hold"},
                    {"fields", {{"port", "mouse.target_velocity_in"}, {"value", velocity}, {"take", false}}}};
    CHECK(WebRig::answer(browser, hold)["ok"] == true);
    RawBrowser other = rig.open();
    const auto not_mine = WebRig::answer(other, hold);
    CHECK(not_mine["ok"] == false);
    CHECK(not_mine["text"].get<std::string>().find("browser 1") != std::string::npos);
}

TEST_CASE("a browser's holds end with its connection, velocities with zero", "[web]") {
    WebRig rig;
    {
        RawBrowser browser = rig.open();
        const Json hold{{"do", "act"},
                        {"id", 8},
                        {"act", "Hold"},
                        {"fields", {{"port", "mouse.target_velocity_in"}, {"value", velocity}, {"take", false}}}};
        CHECK(WebRig::answer(browser, hold)["ok"] == true);
        CHECK(rig.live->system().port("mouse.target_velocity_in").value()->override() == Override::held);
    }
    CHECK(has_gone(rig));
    const auto port = rig.live->system().port("mouse.target_velocity_in");
    CHECK(port.value()->override_value().get<Velocity2D>() == Velocity2D{});
    rig.tick(2);
    CHECK(port.value()->override() == Override::none);
}

TEST_CASE("a silent browser is closed within ten seconds, and its holds end", "[web][wallclock]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const Json hold{{"do", "act"},
                    {"id", 8},
                    {"act", "Hold"},
                    {"fields", {{"port", "mouse.target_velocity_in"}, {"value", velocity}, {"take", false}}}};
    CHECK(WebRig::answer(browser, hold)["ok"] == true);
    CHECK(browser.is_closed(10));
    CHECK(has_gone(rig));
    CHECK(rig.live->system().port("mouse.target_velocity_in").value()->override_value().get<Velocity2D>() ==
          Velocity2D{});
}

TEST_CASE("a drive ends by itself without messages from its browser", "[web][wallclock]") {
    WebRig rig;
    rig.paused = false;
    RawBrowser browser = rig.open();
    REQUIRE(browser.send_frame(drive_message(false).dump()));
    CHECK_FALSE(browser.next_text(driven_by_1).empty());
    CHECK_FALSE(browser.next_text(R"("drivers":{})").empty());
    CHECK(rig.live->system().port("mouse.target_velocity_in").value()->override() == Override::none);
}

TEST_CASE("driving a port of another user is refused, or taken over on request, and both users are informed", "[web]") {
    WebRig rig;
    rig.paused = false;
    RawBrowser browser = rig.open(), other = rig.open();
    const Actor first{Actor::Kind::browser, "1"};
    // A hold that does not depend on browser messages, so that no time matters.
    REQUIRE(rig.live->act(Hold{"mouse.target_velocity_in", Velocity2D{.vx = 0.1}}, first));
    REQUIRE(other.send_frame(drive_message(false).dump()));
    const auto refused = Json::parse(other.next_text("\"is\":\"drive\""));
    CHECK(refused["ok"] == false);
    CHECK(refused["text"].get<std::string>().find("browser 1") != std::string::npos);
    REQUIRE(other.send_frame(drive_message(true).dump()));
    CHECK_FALSE(other.next_text(R"("drivers":{"mouse.target_velocity_in":"browser 2"})").empty());
    CHECK(rig.said("its value is held by browser 2 now, no longer by browser 1"));
    Json let_go = drive_message(false);
    let_go["value"] = nullptr;
    REQUIRE(other.send_frame(let_go.dump()));
    CHECK_FALSE(other.next_text(R"("drivers":{})").empty());
}

TEST_CASE("a driver is informed when another user takes over", "[web]") {
    LiveRig rig;
    std::string told;
    Drives drives(*rig.live, [&](ClientId client, const std::string& port, const std::string& why) {
        told = std::to_string(client) + " " + port + ": " + why;
    });
    const DriveMessage message{.port = "mouse.target_velocity_in", .value = Velocity2D{.vx = 0.1}};
    const Drives::Clock::time_point now{};
    REQUIRE(drives.take(1, message, {Actor::Kind::browser, "1"}, now));
    drives.serve(now);
    CHECK(told.empty());
    REQUIRE(rig.live->act(Hold{message.port, Velocity2D{}, true}, {Actor::Kind::console}));
    drives.serve(now);
    CHECK(told == "1 mouse.target_velocity_in: another user drives this port, or the port was removed");
}

TEST_CASE("after half a second of silence a drive is zero for a tick, then released", "[web]") {
    LiveRig rig;
    Drives drives(*rig.live, [](ClientId, const std::string&, const std::string&) {});
    const DriveMessage message{.port = "mouse.target_velocity_in", .value = Velocity2D{.vx = 0.1}};
    const Drives::Clock::time_point now{};
    const auto port = [&] { return rig.live->system().port(message.port).value(); };
    REQUIRE(drives.take(1, message, {Actor::Kind::browser, "1"}, now));
    rig.tick();
    drives.serve(now + std::chrono::milliseconds(500));
    CHECK(port()->override_value().get<Velocity2D>().vx == 0.1);
    drives.serve(now + std::chrono::milliseconds(501));
    CHECK(port()->override_value().get<Velocity2D>() == Velocity2D{});
    rig.tick();
    drives.serve(now + std::chrono::milliseconds(502));
    CHECK(port()->override() == Override::none);
}

TEST_CASE("a stop is processed before all waiting messages", "[web]") {
    const WebRig rig;
    Hub hub(AccessControl(), StaticFiles(""), rig.live->part_reader(), "}");
    hub.opened(1, {});
    CHECK(hub.take().size() == 1);
    for (int i = 0; i < 20; ++i)
        CHECK(hub.received(1, R"({"do":"act","id":1,"act":"Deactivate","fields":{"component":"controller"}})"));
    CHECK(hub.received(1, R"({"do":"stop"})"));
    const auto waiting = hub.take();
    REQUIRE(waiting.size() == 21);
    CHECK(std::holds_alternative<Stop>(std::get<ActMessage>(waiting.front().message.body).act));
}

TEST_CASE("a browser stops all robots and re-arms them", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    CHECK(WebRig::answer(browser, {{"do", "stop"}, {"id", 2}})["ok"] == true);
    CHECK(rig.live->system().is_stopped());
    CHECK(rig.said("browser 1: stop"));
    CHECK(WebRig::answer(browser, {{"do", "rearm"}, {"id", 3}})["ok"] == true);
    CHECK_FALSE(rig.live->system().is_stopped());
}

TEST_CASE("a browser controls time as the console does", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto time = [&](const Json& what, const Json& value = nullptr) {
        return WebRig::answer(browser, {{"do", "time"}, {"id", 9}, {"what", what}, {"value", value}});
    };
    const std::int64_t tick = rig.live->system().now().tick;
    CHECK(time("step", 3)["ok"] == true);
    for (int rounds = 0; rounds < 10; ++rounds) rig.serve();
    CHECK(rig.live->system().now().tick == tick + 3);
    CHECK(time("step", 0.5)["text"] == "expected a whole number of ticks from 1 to 1000000000000, got 0.5");
    CHECK(time("speed", 4)["ok"] == true);
    CHECK(rig.factor_ == 4);
    CHECK(time("speed", -1)["text"] ==
          "expected a factor from 0.001 to 1000000, or \"max\", got -1; pause() stops time");
    CHECK(time("speed", 5e-324)["text"] == "expected a factor from 0.001 to 1000000, or \"max\", got 5e-324");
    CHECK(rig.factor_ == 4);
    CHECK(time("restart")["ok"] == true);
    CHECK(rig.live->starts() == 2);
    rig.hardware = true;
    for (const char* what : {"step", "speed", "restart"})
        CHECK(time(what)["text"] == "this works only in simulation: real robots always run in real time");
    CHECK(time("pause")["ok"] == true);
    CHECK(time("quit")["ok"] == true);
    CHECK(rig.quitting);
}

TEST_CASE("a browser's act that reads files is answered when it has been prepared and performed", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto reload = [&](int id, const std::string& text) {
        const Json fields{{"files", Json::array()}, {"component", "controller"}, {"shown", "page.lua"}, {"text", text}};
        return WebRig::answer(browser, {{"do", "act"}, {"id", id}, {"act", "Reload"}, {"fields", fields}});
    };
    CHECK(reload(1, "output(")["text"] == "page.lua:1: unexpected symbol near <eof>; still running version 1");
    CHECK(rig.live->system().find("controller")->version() == 1);
    CHECK(reload(2, "local out = output('out', 'TimedVelocity2D')")["ok"] == true);
    CHECK(rig.live->system().find("controller")->version() == 2);
}

TEST_CASE("while an act of a browser is prepared, a second one is refused", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto reload = [](int id) {
        const Json fields{{"files", Json::array()},
                          {"component", "controller"},
                          {"shown", "page.lua"},
                          {"text", "output('out', 'TimedVelocity2D') for i = 1, 1e6 do end"}};
        return Json{{"do", "act"}, {"id", id}, {"act", "Reload"}, {"fields", fields}};
    };
    // The first may be done before the second arrives, on a busy machine.
    std::string refused;
    for (int attempt = 0; attempt < 50 && refused.empty(); ++attempt) {
        REQUIRE(browser.send_frame(reload(2 * attempt).dump()));
        const auto answer = WebRig::answer(browser, reload(2 * attempt + 1));
        if (answer["ok"] == false) refused = answer["text"];
    }
    CHECK(refused == "another act is still being prepared: try again when it is done");
}

TEST_CASE("each browser has its own console", "[web]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    REQUIRE(browser.send_frame(
        R"({"do":"console","request":{"do":"eval","id":5,"text":"controller.config.speed_x = 0.5 return 1 + 1"}})"));
    const auto output = Json::parse(browser.next_text("\"output\""));
    CHECK(output["is"] == "console");
    CHECK(output["event"]["text"] == "2");
    CHECK_FALSE(browser.next_text("\"answer\"").empty());
    CHECK(rig.said("browser 1: controller.config.speed_x = 0.5 return 1 + 1"));
    const Json hold{{"do", "eval"}, {"id", 6}, {"text", "hold('mouse.target_velocity_in', { vx = 0.1 })"}};
    REQUIRE(browser.send_frame(Json{{"do", "console"}, {"request", hold}}.dump()));
    CHECK_FALSE(browser.next_text(R"("drivers":{"mouse.target_velocity_in":"browser 1"})").empty());
}

TEST_CASE("a camera's picture comes as JPEG while it is watched", "[web]") {
    const std::string camera = R"lua(
local out = output("out", "CameraImage", "a picture")
function on_execute()
  out:write { width = 64, height = 48, bpp = 16, format = "yuv422_yuy2", pixels = ("\200\100"):rep(64 * 48) }
end
)lua";
    WebRig rig(R"(behavior "eye" { script = "eye" })", {{"eye", camera}});
    rig.paused = false;
    RawBrowser browser = rig.open();
    REQUIRE(browser.send_frame(R"({"do":"watch","pictures":["eye.out"]})"));
    for (;;) {
        const auto got = browser.next();
        REQUIRE(got);
        if (got->opcode != 2 || got->bytes[0] != 2) continue;
        const Octets bytes(got->bytes.begin() + 4, got->bytes.end());
        WebPicture picture;
        REQUIRE(read_cdr(bytes, {}, picture));
        CHECK(picture.port == "eye.out");
        CHECK(picture.width == 64);
        CHECK(picture.height == 48);
        REQUIRE(picture.jpeg.size() > 100);
        CHECK(picture.jpeg[0] == 0xff);
        CHECK(picture.jpeg[1] == 0xd8);
        break;
    }
}

TEST_CASE("a browser gets what is remembered of a branch: places, acts and collisions", "[web][past]") {
    WebRig it;
    it.live->remember_run();
    RawBrowser browser = it.open(it.view_token);  // looking needs no more
    it.turn(100);
    REQUIRE(it.live->act(SetParameter{"controller", "speed_x", 0.5}, {Actor::Kind::console, ""}));
    it.turn(200);
    REQUIRE(browser.send_frame(R"({"do":"remembered","branch":"main","rows":true})"));
    const Json main = Json::parse(browser.next_text(R"("is":"remembered")"));
    CHECK(main["branch"] == "main");
    CHECK(main["rows"].size() >= 60);
    CHECK(main["rows"][0].size() == 4);
    CHECK(main["rows"][0][0] == 0.05);
    REQUIRE(!main["marks"].empty());
    CHECK(main["marks"][0]["kind"] == "act");
    CHECK(main["marks"][0]["at"] == 1.0);
    CHECK(main["marks"][0]["text"].get<std::string>().find("set parameter by") == 0);
    REQUIRE(browser.send_frame(R"({"do":"remembered","branch":"main"})"));
    CHECK_FALSE(Json::parse(browser.next_text(R"("is":"remembered")")).contains("rows"));
    CHECK(WebRig::answer(browser, {{"do", "remembered"}, {"branch", "x"}, {"id", 3}})["text"] ==
          "there is no branch 'x'");
}

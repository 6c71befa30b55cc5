// Profiles of RTCBuilder: what is read of all versions, what is refused, and what comes back from what is written.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "bindings/openrtm/component_profile.hpp"
#include "bindings/openrtm/system_profile.hpp"
#include "engine/values/value_text.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/live_rig.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;

namespace {

ComponentProfile shipped(const std::string& name) {
    const std::string file = (root / "tests/golden/rtc_profiles" / (name + ".xml")).string();
    const auto profile = read_component_profile(text_of_file(file), name);
    INFO(name);
    REQUIRE(profile);
    return *profile;
}

std::string reading_error(const std::string& text) {
    const auto profile = read_component_profile(text, "RTC.xml");
    return profile ? "no error" : describe(profile.error());
}

const ParameterSpec& parameter(const ComponentProfile& profile, const std::string& name) {
    for (const ParameterSpec& spec : profile.parameters) {
        if (spec.name == name) return spec;
    }
    FAIL("there is no parameter " << name);
    return profile.parameters.front();
}

// As a declaration says it: "0.5 [0, 1] { 1, 2 } spin 0.1 rad: doc".
std::string said(const ComponentProfile& profile, const std::string& name) {
    const ParameterSpec& spec = parameter(profile, name);
    std::string text = lua_text(spec.initial);
    if (spec.min || spec.max)
        text += fmt::format(" [{}, {}]", spec.min ? fmt::format("{}", *spec.min) : "",
                            spec.max ? fmt::format("{}", *spec.max) : "");
    for (const Value& choice : spec.choices) text += " " + lua_text(choice);
    if (!spec.widget.empty()) text += " " + spec.widget;
    if (spec.step > 0) text += fmt::format(" {}", spec.step);
    if (!spec.unit.empty()) text += " " + spec.unit;
    return spec.doc.empty() ? text : text + ": " + spec.doc;
}

bool remarks(const ComponentProfile& profile, const std::string& line) {
    UNSCOPED_INFO(fmt::format("{}", fmt::join(profile.remarks, "\n")));
    return std::find(profile.remarks.begin(), profile.remarks.end(), line) != profile.remarks.end();
}

constexpr const char* date = "2026-01-31T12:00:00Z";

}  // namespace

TEST_CASE("a profile has a component's vendor, description and callbacks", "[openrtm][profile]") {
    const ComponentProfile walker = shipped("grid_walker_02");
    CHECK(walker.name == "Grid_Walker");
    CHECK(walker.doc == "Walks along a path on a grid.");
    CHECK((walker.version == "1.2.0" && walker.vendor == "Nezumi Lab" && walker.category == "Navigation"));
    CHECK(walker.rate == 1000);
    CHECK(walker.callbacks == std::vector<std::string>{"on_activated", "on_deactivated", "on_execute"});
    CHECK(shipped("other_tool_03").doc == "Was written by another program.");
}

TEST_CASE("the texts of a profile may be Japanese, with HTML's line breaks", "[openrtm][profile]") {
    const ComponentProfile servo = shipped("servo_02");
    CHECK(servo.doc == "サーボモーターを動かすコンポーネント\n目標角度をPWM信号に変える。\n角度の単位はラジアン。");
    CHECK(servo.vendor == "ネズミ研究室");
    CHECK(servo.ports.front().doc == "目標角度 [rad]; number: 6");
    CHECK(said(servo, "steps") == "10 spin 回: 補間の回数; range: 1から100");
    CHECK(remarks(servo, "creator: ネズミ研究室 nezumi@example.com"));
    CHECK(remarks(servo, "callback OnActivated, description: サーボの電源を入れる"));
}

TEST_CASE("ports have the names of their types, units and documents", "[openrtm][profile]") {
    const ComponentProfile tower = shipped("light_tower_01");
    REQUIRE(tower.ports.size() == 3);
    CHECK((tower.ports[0].direction == Direction::in && tower.ports[0].type == "TimedBooleanSeq"));
    CHECK((tower.ports[2].direction == Direction::out && tower.ports[2].doc == "Current of each lamp. [Amps.]"));
    CHECK(tower.ports[1].doc ==
          "The lamps that are lit.; semantics: True while the lamp has current.; number: Variable.");
    CHECK(shipped("names_03").ports.back().type == "TimedShort");
    CHECK(shipped("sheet_writer_02").ports[1].type == "Img/TimedCameraImage");
}

TEST_CASE("defaults are read as several languages write them", "[openrtm][profile]") {
    const ComponentProfile walker = shipped("grid_walker_02"), mixer = shipped("wheel_mixer_03");
    CHECK(said(walker, "cell_size") == "0.18 text");
    CHECK(said(walker, "turn_gain") == "2.0 text");
    CHECK(said(walker, "use_map") == "true text");
    CHECK(said(walker, "map_name") == "\"room one\" text");
    CHECK(said(walker, "address") == "\"0x6A\" text");
    CHECK(said(walker, "register") == "106 text");
    CHECK(said(walker, "timeOut") == "3.0 text");
    CHECK(said(mixer, "ratios") == "{ 1.0, -1.0 } text");
    CHECK(said(mixer, "inverted") == "false checkbox");
    CHECK(said(mixer, "enabled") == "true text");
    CHECK(said(mixer, "names") == "{ \"left\", \"right\" } text");
    CHECK(said(mixer, "mode") == "\"fast\" text");
    CHECK(remarks(mixer, "parameter 'mode': its type 'Mode' is unknown, so it becomes a string"));
}

TEST_CASE("constraints are bounds and choices; what can't be said here is a remark", "[openrtm][profile]") {
    const ComponentProfile servo = shipped("servo_02"), motion = shipped("motion_02");
    CHECK(said(servo, "bus_address") == "\"0x40\" \"0x40\" \"0x41\" \"0x42\" radio: I2Cのアドレス");
    CHECK(said(servo, "brightness") == "255 [0, 255] slider 1: 表示の明るさ");
    CHECK(said(servo, "offset") == "0.0 [-1.57, 1.57] spin 0.01 rad: 角度のずれ");
    CHECK(said(motion, "motion_time") == "300 [1, 5000] text ms");
    CHECK(said(motion, "gain") == "0.5 [0, ] text");
    CHECK(remarks(motion, "parameter 'gain': that 0 itself is not allowed (bounds are inclusive here)"));
    CHECK(said(motion, "encoding") == "2 2 3 spin");
    CHECK(remarks(motion, "parameter 'encoding': the names of its choices"));
    CHECK(said(motion, "weights") == "{ 1.0, 0.5 } [0, 1] text");
    CHECK(said(motion, "pair") == "{ 1, 20 } text");
    CHECK(remarks(motion, "parameter 'pair': a constraint that differs between elements"));
    CHECK(said(motion, "label") == "\"run\" text");
    CHECK(remarks(motion, "parameter 'label': the constraint <rtc:propertyIsLike>"));
    CHECK(said(motion, "channels") == "{ \"left\", \"right\" } \"left\" \"right\" \"both\" checkbox");
    CHECK(said(motion, "start") == "0");
    CHECK(remarks(motion, "parameter 'start' (integer): 0 is below its minimum 1, in its default"));
    CHECK(remarks(
        motion,
        "parameter 'ids': its default is an empty array of 'vector<int>', so the type of its elements is unknown"));
}

TEST_CASE("each element of a profile without counterpart in nezumi gives one remark", "[openrtm][profile]") {
    CHECK(shipped("light_tower_01").remarks ==
          std::vector<std::string>{"executes: PERIODIC at 1 Hz; nezumi uses the system's rate",
                                   "service port 'towerServices': provides LampService of Lamps.idl", "language: Cxx"});
    CHECK(remarks(shipped("grid_walker_02"),
                  "service port 'mapClient': requires RTC::GridMapServer of C:\\A\\idl\\GridMap.idl"));
    const ComponentProfile sheet = shipped("sheet_writer_02"), names = shipped("names_03");
    for (const char* line :
         {"maxInstances: 10", "license: LGPL", "history: 2.1.0: more columns", "callback OnModeChanged",
          "language: Python", "operating system: Windows", "library: SheetLibrary 4.1 https://example.com"}) {
        CHECK(remarks(sheet, line));
    }
    CHECK(remarks(names, "executes: EVENTDRIVEN; nezumi uses the system's rate"));
    CHECK(remarks(names, "executionType: ExtTrigExecutionContext"));
    CHECK(remarks(shipped("other_tool_03"), "service port 'empty'"));
}

TEST_CASE("a file that is not a profile is refused in one line", "[openrtm][profile]") {
    CHECK(reading_error("") == "RTC.xml:1: expected the XML of a profile: No document element found");
    CHECK(reading_error("<a>\n<b>\n</a>") == "RTC.xml:3: expected the XML of a profile: Start-end tags mismatch");
    CHECK(reading_error("<rts:RtsProfile/>") == "RTC.xml: expected a profile with <RtcProfile>, got <rts:RtsProfile>");
    CHECK(reading_error("<RtcProfile/>") == "RTC.xml: has no component: BasicInfo has no name");
    CHECK(reading_error("<!DOCTYPE a [<!ENTITY b \"c\">]><RtcProfile/>") ==
          "RTC.xml: has a DOCTYPE, which a profile can't have: remove it");
    CHECK(reading_error("<RtcProfile><BasicInfo name=\"\x93\xfa\x96\x7b\"/></RtcProfile>") ==
          "RTC.xml: is not UTF-8 text: save it as UTF-8");
    std::string deep;
    for (int i = 0; i < 100'000; ++i) deep += "<a>";
    for (int i = 0; i < 100'000; ++i) deep += "</a>";
    CHECK(reading_error("<RtcProfile>" + deep + "</RtcProfile>") ==
          "RTC.xml: has more than 100 nested elements, too many for a profile");
    CHECK(reading_error(std::string(5'000'000, ' ')) ==
          "RTC.xml: has 5000000 bytes, and a profile has at most 4194304");
}

TEST_CASE("a profile reads back as it was written", "[openrtm][profile]") {
    ComponentProfile profile{.name = "RobotController",
                             .doc = "Drives.\n\nAnd stops.",
                             .version = "1.0",
                             .vendor = "a & b <c> \"d\"",
                             .category = "制御",
                             .rate = 100,
                             .callbacks = {"on_activated", "on_execute"},
                             .ports = {{.name = "in", .type = "TimedShortSeq", .doc = "nearer\tis larger", .queue = 7},
                                       {.direction = Direction::out,
                                        .name = "out",
                                        .type = "TimedVelocity2D",
                                        .doc = "two\nlines",
                                        .safe = "{\"vx\":0.5}"}}};
    profile.parameters = {
        {.name = "speed", .initial = 0.1, .min = -1.5, .max = 1.5, .step = 0.01, .widget = "slider", .unit = "m/s"},
        {.name = "least", .initial = std::int64_t{1} << 62, .min = 1.0},
        {.name = "most", .initial = 1e-300, .max = 2.0, .step = 0.5, .doc = " spaces "},
        {.name = "quoted", .initial = "\"a\""},
        {.name = "names", .initial = std::vector<std::string>{"a,b", ""}, .min_size = 1, .max_size = 9},
        {.name = "mode", .initial = "\"slow\"", .widget = "radio", .choices = {"\"slow\"", "fast "}},
        {.name = "level",
         .initial = std::int64_t{2},
         .min = 0,
         .max = 5,
         .choices = {std::int64_t{1}, std::int64_t{2}}},
        {.name = "only", .initial = "x", .choices = {"x"}},
        {.name = "pair",
         .initial = std::vector<double>{1, 2},
         .choices = {std::vector<double>{1, 2}, std::vector<double>{3, 4}}},
        {.name = "on", .initial = true, .widget = "checkbox"}};
    const auto written = write_component_profile(profile, date);
    REQUIRE(written);
    auto read = read_component_profile(*written, "RTC.xml");
    REQUIRE(read);
    CHECK(read->doc == profile.doc);
    CHECK(read->vendor == profile.vendor);
    CHECK(read->callbacks == profile.callbacks);
    CHECK(read->remarks == std::vector<std::string>{"executes: PERIODIC at 100 Hz; nezumi uses the system's rate"});
    REQUIRE(read->ports.size() == 2);
    CHECK((read->ports[0].queue == 7 && read->ports[0].doc == "nearer\tis larger"));
    CHECK((read->ports[1].safe == "{\"vx\":0.5}" && read->ports[1].doc == "two\nlines"));
    REQUIRE(read->parameters.size() == profile.parameters.size());
    for (std::size_t i = 0; i < profile.parameters.size(); ++i) {
        const ParameterSpec &now = read->parameters[i], &before = profile.parameters[i];
        INFO(before.name);
        CHECK(now.name == before.name);
        CHECK(lua_text(now.initial) == lua_text(before.initial));
        CHECK((now.min == before.min && now.max == before.max && now.step == before.step));
        CHECK((now.widget == before.widget && now.unit == before.unit && now.doc == before.doc));
        CHECK(now.choices == before.choices);
        CHECK((now.min_size == before.min_size && now.max_size == before.max_size));
    }
    CHECK(write_component_profile(*read, date) == *written);
}

TEST_CASE("a written profile has what RTCBuilder's schema asks for", "[openrtm][profile]") {
    const auto written =
        write_component_profile({.name = "Mixer", .version = "2.0", .vendor = "v", .category = "c"}, date);
    REQUIRE(written);
    for (const char* part :
         {"<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>", "rtc:version=\"0.3\"",
          "rtc:id=\"RTC:v:c:Mixer:2.0\"", "xmlns:rtcExt=\"http://www.openrtp.org/namespaces/rtc_ext\"",
          "rtc:componentType=\"STATIC\"", "rtc:activityType=\"PERIODIC\"",
          "rtc:executionType=\"PeriodicExecutionContext\"", "rtc:creationDate=\"2026-01-31T12:00:00Z\"",
          "rtc:updateDate=\"2026-01-31T12:00:00Z\"",
          "<rtc:OnInitialize xsi:type=\"rtcDoc:action_status_doc\" rtc:implemented=\"true\" />",
          "<rtc:OnExecute xsi:type=\"rtcDoc:action_status_doc\" rtc:implemented=\"false\" />"}) {
        INFO(part);
        CHECK(written->find(part) != std::string::npos);
    }
}

TEST_CASE("a text that XML can't hold is refused", "[openrtm][profile]") {
    const auto control = write_component_profile({.name = "A", .doc = "a\x01z"}, date);
    REQUIRE_FALSE(control);
    CHECK(control.error().message == "'a\\x01z' has a character that XML can't hold");
    CHECK_FALSE(write_component_profile({.name = "A", .vendor = "\xff"}, date));
}

TEST_CASE("a system's profile reads back as it was written", "[openrtm][profile]") {
    const LiveRig rig(
        "robot \"mouse\" { model = \"raspimouse\" }\n"
        "behavior \"c\" { script = \"c\", rate = 50, sets = { fast = { speed = 0.4 } }, set = \"fast\" }\n"
        "connect(\"c.out\", \"mouse.target_velocity_in\")\n"
        "rtm { export = \"c\" }\nconnect(\"rtm:pc.host_cxt/Viewer3.out\", \"c.in\")",
        {{"c",
          "input(\"in\", \"TimedLong\") output(\"out\", \"TimedVelocity2D\") param(\"speed\", 0.1)\n"
          "about { version = \"1.0\", vendor = \"Lab\", category = \"test\" }"}});
    const SystemProfile profile = profile_of_system(rig.live->system(), rig.live->spec());
    REQUIRE(profile.components.size() == 3);
    CHECK((profile.components[1].type == "C" && profile.components[1].instance == "c0"));
    CHECK((profile.components[2].type == "Viewer" && profile.components[2].instance == "Viewer3"));
    REQUIRE(profile.connections.size() == 2);
    CHECK(profile.connections[0].type == "IDL:RTC/TimedVelocity2D:1.0");
    CHECK((profile.connections[1].from.instance == "Viewer3" && profile.connections[1].to.port == "in"));
    const auto written = write_system_profile(profile, date);
    REQUIRE(written);
    const auto read = read_system_profile(*written, "RTS.xml");
    REQUIRE(read);
    CHECK(read->remarks.empty());
    CHECK((read->components[1].set == "fast" && read->components[1].rate == 50));
    CHECK((read->components[1].vendor == "Lab" && read->components[1].version == "1.0"));
    CHECK(read->components[1].sets == profile.components[1].sets);
    CHECK(write_system_profile(*read, date) == *written);
}

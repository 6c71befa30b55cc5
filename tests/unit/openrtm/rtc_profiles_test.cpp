// What RTCs see of a system's components.
#include <catch2/catch.hpp>
#include <string>

#include "bindings/openrtm/rtc_profiles.hpp"
#include "bindings/openrtm/rtm_word.hpp"
#include "engine/values/value_text.hpp"
#include "tests/unit/live_rig.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;

namespace {

const std::string all_kinds = R"(
input("in", "TimedShortSeq", "numbers")
input("lens", "CameraIntrinsics", "OpenRTM has none")
output("out", "TimedVelocity2D", "velocity")
param("speed_x", 0.25, { min = -1.5, max = 1.5, step = 0.01, widget = "slider" })
param("count", 30, { min = 0 })
param("on", true)
param("text", "a, b")
param("mode", "slow", { choices = { "slow", "fast" }, widget = "radio" })
param("gains", { 1.0, 0.5 })
)";

const Texts& set_of(const RtcSnapshot& snapshot, const std::string& name) {
    for (const auto& [id, texts] : snapshot.sets) {
        if (id == name) return texts;
    }
    FAIL("there is no set " << name);
    return snapshot.sets.front().second;
}

std::string error_of(const LiveRig& rig) {
    const SystemSpec& spec = rig.live->spec();
    const auto profiles = profiles_of(rig.live->system(), *RtmWord::find(spec));
    return profiles ? "no error" : profiles.error().message;
}

std::string error_of(const std::string& more) {
    try {
        return error_of(LiveRig("behavior \"c\" { script = \"all\" }\n" + more, {{"all", all_kinds}}));
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();  // begins with its place
        return text.substr(text.find(": ") + 2);
    }
}

}  // namespace

TEST_CASE("a component is exported with its ports, whose types OpenRTM knows", "[openrtm][profiles]") {
    const LiveRig rig(
        "behavior \"c\" { script = \"all\", rate = 50 }\nrtm { export = \"c\", rename = { [\"c.in\"] = \"ir\" } }",
        {{"all", all_kinds}});
    const auto profiles = profiles_of(rig.live->system(), *RtmWord::find(rig.live->spec()));
    REQUIRE(profiles);
    CHECK(*profiles == std::vector<RtcProfile>{{.component = "c",
                                                .type = "All",
                                                .rate = 50,
                                                .ports = {{"c.in", "ir", "TimedShortSeq", true},
                                                          {"c.out", "out", "TimedVelocity2D", false}}}});
}

TEST_CASE("a robot is exported as a component", "[openrtm][profiles]") {
    const LiveRig rig("robot \"mouse\" { model = \"raspimouse\" }\nrtm { export = \"mouse\" }");
    const auto profiles = profiles_of(rig.live->system(), *RtmWord::find(rig.live->spec()));
    REQUIRE(profiles);
    REQUIRE(profiles->size() == 1);
    CHECK(profiles->front().rate == 100);
    const auto& ports = profiles->front().ports;
    CHECK(std::find(ports.begin(), ports.end(),
                    RtcPort{"mouse.target_velocity_in", "target_velocity_in", "TimedVelocity2D", true}) != ports.end());
}

TEST_CASE("parameters are a configuration set, with widgets, bounds and types as tools know them",
          "[openrtm][profiles]") {
    const LiveRig rig("behavior \"c\" { script = \"all\" }", {{"all", all_kinds}});
    const RtcSnapshot snapshot = look_at(*rig.live->system().find("c"));
    CHECK(snapshot.state == RtcState::active);
    CHECK(snapshot.set == "default");
    CHECK(set_of(snapshot, "default") == Texts{{"speed_x", "0.25"},
                                               {"count", "30"},
                                               {"on", "true"},
                                               {"text", "a, b"},
                                               {"mode", "slow"},
                                               {"gains", "1,0.5"}});
    CHECK(set_of(snapshot, "__widget__") == Texts{{"speed_x", "slider.0.01"}, {"mode", "radio"}});
    CHECK(set_of(snapshot, "__constraints__") ==
          Texts{{"speed_x", "-1.5<=x<=1.5"}, {"count", "0<=x"}, {"mode", "(slow,fast)"}});
    CHECK(set_of(snapshot, "__type__") == Texts{{"speed_x", "double"},
                                                {"count", "long"},
                                                {"on", "bool"},
                                                {"text", "string"},
                                                {"mode", "string"},
                                                {"gains", "vector<double>"}});
}

TEST_CASE("named sets become configuration sets, and the active set has the current values", "[openrtm][profiles]") {
    LiveRig rig(
        "behavior \"c\" { script = \"all\", config = { count = 5 }, sets = { fast = { speed_x = 1.0 }, slow = { "
        "speed_x "
        "= 0.1 } }, set = \"slow\" }",
        {{"all", all_kinds}});
    REQUIRE(rig.live->act(SetParameter{"c", "speed_x", 0.125}, {Actor::Kind::console}));
    rig.tick();
    const RtcSnapshot snapshot = look_at(*rig.live->system().find("c"));
    CHECK(snapshot.set == "slow");
    CHECK(set_of(snapshot, "slow")[0].second == "0.125");
    CHECK(set_of(snapshot, "slow")[1].second == "5");
    CHECK(set_of(snapshot, "fast")[0].second == "1");
    CHECK(set_of(snapshot, "fast")[1].second == "5");
    CHECK(set_of(snapshot, "default")[0].second == "0.25");
}

TEST_CASE("a component has the description of its file", "[openrtm][profiles]") {
    const LiveRig rig(
        "behavior \"c\" { script = \"all\" }\nrobot \"mouse\" { model = \"raspimouse\" }",
        {{"all",
          "--- Turns and turns.\nabout { version = \"2.1\", vendor = \"us\", category = \"toys\" }" + all_kinds}});
    const RtcSnapshot snapshot = look_at(*rig.live->system().find("c"));
    CHECK(snapshot.description == "Turns and turns.");
    CHECK(snapshot.version == "2.1");
    CHECK(snapshot.vendor == "us");
    CHECK(snapshot.category == "toys");
    CHECK(look_at(*rig.live->system().find("mouse")).description.empty());
}

TEST_CASE("a state of an RTC is that of the life cycle", "[openrtm][profiles]") {
    LiveRig rig("behavior \"c\" { script = \"all\" }", {{"all", all_kinds + "function on_execute() error('x') end"}});
    REQUIRE(rig.live->act(Deactivate{"c"}, {Actor::Kind::console}));
    CHECK(look_at(*rig.live->system().find("c")).state == RtcState::inactive);
    REQUIRE(rig.live->act(Activate{"c"}, {Actor::Kind::console}));
    rig.tick(2);
    CHECK(look_at(*rig.live->system().find("c")).state == RtcState::error);
}

TEST_CASE("values of every type are converted to text and back", "[openrtm][profiles]") {
    const std::vector<Value> values{true,
                                    std::int64_t{-30},
                                    0.1,
                                    std::string("a, b"),
                                    std::vector<bool>{true, false},
                                    std::vector<std::int64_t>{1, -2},
                                    std::vector<double>{0.5, 1e-9},
                                    std::vector<std::string>{"a", "b c"}};
    for (const Value& value : values) {
        CAPTURE(lua_text(value));
        CHECK(from_rtc_text(to_rtc_text(value), value) == value);
    }
    CHECK(from_rtc_text(" 0.5 ", 1.0) == Value(0.5));
    CHECK(from_rtc_text("1", false) == Value(true));
    CHECK(from_rtc_text("1, 2", std::vector<double>{}) == Value(std::vector<double>{1, 2}));
    CHECK(from_rtc_text("", std::vector<double>{1}) == Value(std::vector<double>{}));
}

TEST_CASE("a text that is not a value of the type is refused", "[openrtm][profiles]") {
    CHECK_FALSE(from_rtc_text("fast", 1.0));
    CHECK_FALSE(from_rtc_text("0.5x", 1.0));
    CHECK_FALSE(from_rtc_text("", 1.0));
    CHECK_FALSE(from_rtc_text("0.5", std::int64_t{1}));
    CHECK_FALSE(from_rtc_text("99999999999999999999", std::int64_t{1}));
    CHECK_FALSE(from_rtc_text("yes please", true));
    CHECK_FALSE(from_rtc_text("1,,2", std::vector<double>{}));
}

TEST_CASE("a connection to an RTC needs a fitting port of ours", "[openrtm][profiles]") {
    const std::string exported = "rtm { export = \"c\" }\n";
    CHECK(error_of(exported + "connect(\"rtm:Out0.out\", \"c.in\") connect(\"c.out\", \"rtm:In0.in\")") == "no error");
    CHECK(error_of(exported + "connect(\"rtm:Out0.out\", \"c.out\")") ==
          "connect: c.out is an out-port: connect goes from an out-port to an in-port");
    CHECK(error_of(exported + "connect(\"c.in\", \"rtm:In0.in\")") ==
          "connect: c.in is an in-port: connect goes from an out-port to an in-port");
    CHECK(error_of(exported + "connect(\"rtm:Out0.out\", \"c.lens\")") ==
          "connect: c.lens is a CameraIntrinsics, which OpenRTM does not know");
    CHECK(error_of(exported + "connect(\"rtm:Out0.out\", \"c.inn\")").find("(did you mean 'in'?)") !=
          std::string::npos);
}

TEST_CASE("a new name must belong to an exported port and be unique", "[openrtm][profiles]") {
    CHECK(error_of("rtm { export = \"c\", rename = { [\"c.inn\"] = \"x\" } }") ==
          "rtm: field 'rename': there is no exported port 'c.inn' (did you mean 'c.in'?)");
    CHECK(error_of("rtm { export = \"c\", rename = { [\"c.in\"] = \"out\" } }") ==
          "rtm: two ports of c are called 'out'");
}

// What the page is told of RTCs: their widgets, and the connections that tools have made.
#include "bindings/openrtm/peers_json.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bindings/openrtm/peer_parameters.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;

namespace {

using SeenPage = nlohmann::json;

PeerSnapshot peer_with(const std::string& value, const std::string& widget, const std::string& constraint,
                       const std::string& type) {
    PeerSnapshot peer{.name = "pc.host_cxt/In0", .set = "default", .sets = {{"default", {{"gain", value}}}}};
    for (const auto& [set, text] : {std::pair<std::string, std::string>{"__widget__", widget},
                                    {"__constraints__", constraint},
                                    {"__type__", type}}) {
        if (!text.empty()) peer.sets.push_back({set, {{"gain", text}}});
    }
    return peer;
}

PeerParameter parameter(const std::string& value, const std::string& widget, const std::string& constraint,
                        const std::string& type) {
    const auto all = parameters_of(peer_with(value, widget, constraint, type));
    REQUIRE(all.size() == 1);
    return all.front();
}

PeerSnapshot::Port port(const std::string& name, bool is_in, std::vector<std::string> ids) {
    return {.name = name, .type = "TimedLong", .is_in = is_in, .connections = std::move(ids)};
}

SeenPage seen_page(std::vector<PeerSnapshot> peers) {
    return SeenPage::parse(peers_to_json({.peers = std::move(peers)}, "pc.host_cxt"));
}

}  // namespace

TEST_CASE("a parameter of an RTC has the widget, step and bounds that it gives to tools", "[openrtm][peers]") {
    const PeerParameter slider = parameter("0.5", "slider.0.1", "-1.5<=x<=2", "double");
    CHECK(slider.value == Value(0.5));
    CHECK(slider.spec.widget == "slider");
    CHECK(slider.spec.step == 0.1);
    CHECK((slider.spec.min == -1.5 && slider.spec.max == 2));

    const PeerParameter whole = parameter("5", "spin", "3 < x < 10", "int");
    CHECK(whole.value == Value(std::int64_t{5}));
    CHECK((whole.spec.min == 4 && whole.spec.max == 9));

    const PeerParameter turned = parameter("5", "text", "10>=x", "long");
    CHECK((!turned.spec.min && turned.spec.max == 10));
}

TEST_CASE("choices of an RTC's parameter are values of its type", "[openrtm][peers]") {
    const PeerParameter radio = parameter("low", "radio", "(low, high)", "string");
    CHECK(radio.spec.choices == std::vector<Value>{Value("low"), Value("high")});
    const PeerParameter rates = parameter("9600", "radio", "(9600,19200)", "int");
    CHECK(rates.spec.choices == std::vector<Value>{Value(std::int64_t{9600}), Value(std::int64_t{19200})});
    CHECK(parameter("1", "radio", "(1,a)", "int").spec.choices.empty());
}

TEST_CASE("a parameter without a type is a text, unless its widget is one of numbers", "[openrtm][peers]") {
    CHECK(parameter("007", "", "", "").value == Value("007"));
    CHECK(parameter("7", "slider.1", "", "").value == Value(7.0));
    CHECK(parameter("seven", "spin", "", "int").value == Value("seven"));
    CHECK(parameter("1,2.5", "text", "", "std::vector<double>").value == Value(std::vector<double>{1, 2.5}));
}

TEST_CASE("a constraint that is not understood bounds nothing", "[openrtm][peers]") {
    for (const std::string text : {"x", "<", "<<<", "a<b", "1<2", "nan<x", "(", ")", "()", "{a: x<1}", "x==5"}) {
        const PeerParameter parameter_of = parameter("5", "text", text, "double");
        INFO(text);
        CHECK((!parameter_of.spec.min && !parameter_of.spec.max));
        CHECK(parameter_of.spec.choices.empty());
    }
}

TEST_CASE("connections of other RTCs are found by their ids, and have our names where a port is ours",
          "[openrtm][peers]") {
    PeerSnapshot ours{.name = "pc.host_cxt/mouse0", .is_ours = true};
    ours.ports = {port("speed", true, {"b", "e"}), port("pose", false, {"e"})};
    ours.ports[0].path = "mouse.target_velocity_in";
    ours.ports[1].path = "mouse.pose";
    const SeenPage page = seen_page({{.name = "pc.host_cxt/Out0", .ports = {port("out", false, {"a", "b", "c"})}},
                                     {.name = "far.host_cxt/In0", .ports = {port("in", true, {"a", "d"})}},
                                     std::move(ours)});
    CHECK(page["connections"] == SeenPage{{{"from", "rtm:Out0.out"}, {"to", "rtm:far.host_cxt/In0.in"}},
                                          {{"from", "rtm:Out0.out"}, {"to", "mouse.target_velocity_in"}}});
    CHECK(page["rtcs"].size() == 2);
    CHECK(page["rtcs"][0]["name"] == "rtm:Out0");
    CHECK(page["ports"] == SeenPage{{"mouse.target_velocity_in", "TimedLong"}, {"mouse.pose", "TimedLong"}});
}

TEST_CASE("connected service ports are shown as connected", "[openrtm][peers]") {
    PeerSnapshot::Port service{.name = "service", .connections = {"s"}};
    const SeenPage page =
        seen_page({{.name = "pc.host_cxt/A0", .ports = {service}}, {.name = "pc.host_cxt/B0", .ports = {service}}});
    CHECK(page["rtcs"][0]["ports"][0]["way"] == "service");
    CHECK(page["connections"] == SeenPage{{{"from", "rtm:A0.service"}, {"to", "rtm:B0.service"}}});
}

TEST_CASE("the list of RTCs that the page gets is limited in size", "[openrtm][peers]") {
    std::vector<PeerSnapshot> many;
    for (int i = 0; i < 300; ++i) {
        PeerSnapshot peer{.name = "pc.host_cxt/" + std::string(1000, 'x') + std::to_string(i), .type = "\xff\xfe"};
        for (int j = 0; j < 200; ++j) peer.ports.push_back(port(std::string(1000, 'p'), i % 2 == 0, {"same"}));
        many.push_back(std::move(peer));
    }
    const SeenPage page = seen_page(std::move(many));
    CHECK(page["rtcs"].size() == 200);
    CHECK(page["rtcs"][0]["ports"].size() == 100);
    CHECK(page["connections"].size() <= 32 * 32);
}

TEST_CASE("a name service that is away is a problem on the page", "[openrtm][peers]") {
    const SeenPage page = SeenPage::parse(peers_to_json({.problem = "no name service answers"}, "pc.host_cxt"));
    CHECK(page["problem"] == "no name service answers");
    CHECK(page["rtcs"].empty());
}

// A live system among RTCs: what they see, send and change.
#include "bindings/openrtm/rtm_word.hpp"
#include "tests/unit/openrtm/server_rig.hpp"

using namespace nezumi;
using namespace nezumi::openrtm;

TEST_CASE("a system is shown with its connections", "[openrtm][server]") {
    const ServerRig rig;
    REQUIRE(rig.told.profiles.size() == 2);
    CHECK(rig.told.profiles[0].component == "mouse");
    CHECK(rig.told.profiles[1].component == "controller");
    CHECK(rig.told.links == std::vector<RtcLink>{{"controller.out", "Mouse0", "target_velocity_in"}});
    CHECK(rig.told.options.nameservers == std::vector<std::string>{"localhost:2809"});
    CHECK(rig.told.options.interface == "127.0.0.1");
}

TEST_CASE("a message of an RTC is injected before a tick, by a network peer", "[openrtm][server]") {
    ServerRig rig;
    CHECK(rig.put("mouse.target_velocity_in", Velocity2D{.vx = 0.2}) == PutAnswer::taken);
    CHECK(rig.acts.lines.empty());
    rig.turn();
    CHECK(rig.acts.lines == std::vector<std::string>{"Inject by network Peer0.out_x"});
    CHECK(rig.component("mouse").find_in_port("target_velocity_in")->value() == Value(Velocity2D{.vx = 0.2}));
}

TEST_CASE("a robot driven by an RTC stops half a second after the last message", "[openrtm][server]") {
    ServerRig rig;
    for (int i = 0; i < 50; ++i) {
        REQUIRE(rig.put("mouse.target_velocity_in", Velocity2D{.vx = 0.1}) == PutAnswer::taken);
        rig.turn();
    }
    const Robot& mouse = *rig.live->system().find_robot("mouse");
    CHECK(mouse.guard().current().vx > 0.05);
    rig.turn(100);
    CHECK(mouse.guard().current() == Velocity2D{});
}

TEST_CASE("a robot stops at once when the connection of its velocity ends", "[openrtm][server]") {
    ServerRig rig;
    for (int i = 0; i < 50; ++i) {
        REQUIRE(rig.put("mouse.target_velocity_in", Velocity2D{.vx = 0.1}) == PutAnswer::taken);
        rig.turn();
    }
    rig.server->left("mouse.target_velocity_in", "Peer0.out_x");
    rig.turn(20);
    CHECK(rig.live->system().find_robot("mouse")->guard().current() == Velocity2D{});
}

TEST_CASE("a port's message is sent once in each byte order that is used", "[openrtm][server]") {
    ServerRig rig;
    rig.turn();
    CHECK(rig.told.sent.empty());
    rig.told.wanted["controller.out"] = {.little = true, .big = true};
    rig.turn();
    REQUIRE(rig.told.sent.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::endian order = i == 0 ? std::endian::little : std::endian::big;
        CHECK(rig.told.sent[i].first == (i == 0 ? "controller.out little" : "controller.out big"));
        Value value{Velocity2D{}};
        double tm = 0;
        REQUIRE(read_cdr_message(rig.told.sent[i].second, value, tm, {.order = order}));
        CHECK(value == Value(Velocity2D{.vx = 0.25}));
    }
    rig.server->after_tick();
    CHECK(rig.told.sent.size() == 2);
}

TEST_CASE("changes of life cycle and sets are checked acts", "[openrtm][server]") {
    using What = RtcRequest::What;
    ServerRig rig;
    CHECK(rig.ask({.what = What::deactivate, .component = "controller"}) == RtcAnswer::done);
    CHECK(rig.server->snapshot("controller").state == RtcState::inactive);
    CHECK(rig.ask({.what = What::activate, .component = "controller"}) == RtcAnswer::done);
    // PRECONDITION_NOT_MET: it is so already.
    CHECK(rig.ask({.what = What::activate, .component = "controller"}) == RtcAnswer::refused);
    CHECK(rig.ask({.what = What::activate, .component = "nobody"}) == RtcAnswer::unknown);
    CHECK(rig.ask({.what = What::reset, .component = "controller"}) == RtcAnswer::refused);
    CHECK(rig.ask({.what = What::set, .component = "controller", .set = "default", .values = {{"speed_x", "0.5"}}}) ==
          RtcAnswer::done);
    rig.turn();
    CHECK(rig.component("controller").parameters().find("speed_x")->value.get<double>() == 0.5);
    CHECK(rig.ask({.what = What::use, .component = "controller", .set = "fast"}) == RtcAnswer::done);
    CHECK(rig.server->snapshot("controller").set == "fast");
    CHECK(rig.ask({.what = What::use, .component = "controller", .set = "slow"}) == RtcAnswer::refused);
    CHECK(rig.ask({.what = What::use, .component = "controller", .set = "default"}) == RtcAnswer::done);
    CHECK(rig.server->snapshot("controller").set == "default");
    rig.turn();
    CHECK(rig.component("controller").parameters().find("speed_x")->value.get<double>() == 0.25);
    for (const std::string& line : rig.acts.lines) CHECK(line.find(" by network rtm") != std::string::npos);
}

TEST_CASE("activating the active set again keeps changed values", "[openrtm][server]") {
    using What = RtcRequest::What;
    ServerRig rig;
    for (const std::string set : {"default", "fast"}) {
        CAPTURE(set);
        REQUIRE(rig.ask({.what = What::use, .component = "controller", .set = set}) == RtcAnswer::done);
        REQUIRE(rig.ask({.what = What::set, .component = "controller", .set = set, .values = {{"speed_x", "0.75"}}}) ==
                RtcAnswer::done);
        CHECK(rig.ask({.what = What::use, .component = "controller", .set = set}) == RtcAnswer::done);
        rig.turn();
        CHECK(rig.component("controller").parameters().find("speed_x")->value.get<double>() == 0.75);
    }
}

TEST_CASE("values of a set are accepted all together or not at all", "[openrtm][server]") {
    ServerRig rig;
    const auto set = [&](const std::string& id, Texts values) {
        return rig.ask(
            {.what = RtcRequest::What::set, .component = "controller", .set = id, .values = std::move(values)});
    };
    CHECK(set("default", {{"speed_x", "0.5"}, {"stop_d", "many"}}) == RtcAnswer::refused);
    CHECK(set("default", {{"speed_x", "0.5"}, {"speed_y", "1"}}) == RtcAnswer::unknown);
    CHECK(set("default", {{"speed_x", "9"}}) == RtcAnswer::refused);
    CHECK(set("default", {{"speed_x", "nan"}}) == RtcAnswer::refused);
    CHECK(set("fast", {{"speed_x", "0.3"}}) == RtcAnswer::refused);
    rig.turn();
    CHECK(rig.component("controller").parameters().find("speed_x")->value.get<double>() == 0.25);
    CHECK(rig.acts.lines.empty());
}

TEST_CASE("a restart keeps exports, and a removed component is no longer exported", "[openrtm][server]") {
    ServerRig rig;
    const auto profiles = rig.told.profiles;
    REQUIRE(rig.live->act(Restart{}, {Actor::Kind::console}));
    rig.told.wanted["controller.out"] = {.little = true};
    rig.turn(2);
    CHECK(rig.told.profiles == profiles);
    CHECK_FALSE(rig.told.sent.empty());
    REQUIRE(rig.live->act(Remove{"controller"}, {Actor::Kind::console}));
    rig.turn();
    REQUIRE(rig.told.profiles.size() == 1);
    CHECK(rig.told.links.empty());
    CHECK(rig.put("controller.in", std::vector<std::int16_t>{1}) == PutAnswer::unknown);
}

TEST_CASE("connections to RTCs are made and ended while the system runs", "[openrtm][server]") {
    ServerRig rig;
    const Actor console{Actor::Kind::console};
    const RtcLink first{"controller.out", "Mouse0", "target_velocity_in"};
    REQUIRE(rig.live->act(Connect{"rtm:Out0.out", "controller.in"}, console));
    rig.turn();
    CHECK(rig.told.links == std::vector<RtcLink>{first, {"controller.in", "Out0", "out"}});
    REQUIRE(rig.live->act(Disconnect{"rtm:Out0.out", "controller.in"}, console));
    rig.turn();
    CHECK(rig.told.links == std::vector<RtcLink>{first});
    REQUIRE(rig.live->act(Connect{"controller.out", "rtm:Mouse1.target_velocity_in"}, console));
    REQUIRE(rig.live->act(Connect{"controller.out", "mouse.target_velocity_in"}, console));
    REQUIRE(rig.live->act(Disconnect{"controller.out", ""}, console));
    rig.turn();
    CHECK(rig.told.links.empty());
    CHECK(rig.live->system().connections().empty());
    REQUIRE(rig.live->act(Connect{"controller.out", "rtm:Mouse1.target_velocity_in"}, console));
    REQUIRE(rig.live->act(Disconnect{"rtm:Mouse1.target_velocity_in", ""}, console));
    CHECK(rig.live->system().foreign_connections().empty());
    REQUIRE(rig.live->act(Restart{}, console));
    rig.turn();
    CHECK(rig.told.links == std::vector<RtcLink>{first});
}

TEST_CASE("an impossible connection to an RTC is refused with the reason", "[openrtm][server]") {
    ServerRig rig(exported_system + "robot \"other\" { model = \"raspimouse\", pose = { y = 0.5 } }\n");
    const auto error = [&](const Act& act) {
        const auto done = rig.live->act(act, {Actor::Kind::console});
        return done ? "no error" : done.error().message;
    };
    CHECK(error(Connect{"rtm:Out0.out", "controller.inn"}) == "controller has no port 'inn' (did you mean 'in'?)");
    CHECK(error(Connect{"rtm:Out0.out", "controller.out"}) ==
          "controller.out is an out-port: connect goes from an out-port to an in-port");
    CHECK(error(Connect{"rtm:Out0", "controller.in"}) ==
          "expected \"rtm:NAME.port\" or \"rtm:HOST.host_cxt/NAME.port\", got 'rtm:Out0'");
    CHECK(error(Connect{"rtm:Out0.out", "rtm:In0.in"}) ==
          "both ends are ports of other programs: one of them must be of this system");
    CHECK(error(Connect{"rtm:Out0.out", "other.target_velocity_in"}) ==
          "rtm:Out0.out is a port of another program, which sees only exported components: write rtm { export = { "
          "\"other\" } }");
    CHECK(error(Connect{"controller.out", "rtm:Mouse0.target_velocity_in"}) ==
          "controller.out is connected to rtm:Mouse0.target_velocity_in already");
    CHECK(error(Disconnect{"rtm:Out0.out", "controller.in"}) == "rtm:Out0.out is not connected to controller.in");
    CHECK(error(Disconnect{"rtm:Out0.out", ""}) == "rtm:Out0.out is not connected");
    CHECK(error(Disconnect{"controller.in", ""}) == "controller.in is not connected");
    LiveRig alone;
    CHECK_FALSE(alone.live->act(Connect{"rtm:Out0.out", "controller.in"}, {Actor::Kind::console}));
}

TEST_CASE("a connection removed by a tool is not made again, as after disconnect", "[openrtm][server]") {
    ServerRig rig;
    rig.server->ended({"controller.out", "Mouse0", "target_velocity_in"});
    rig.turn();
    CHECK(rig.told.links.empty());
    CHECK(rig.acts.lines == std::vector<std::string>{"Disconnect by network rtm"});
    CHECK(rig.said_lines ==
          std::vector<std::string>{"disconnected by an RTC or a tool: controller.out to rtm:Mouse0.target_velocity_in; "
                                   "connect(\"controller.out\", \"rtm:Mouse0.target_velocity_in\") makes it again"});
    rig.server->ended({"controller.out", "Mouse0", "target_velocity_in"});
    rig.turn();
    CHECK(rig.acts.lines.size() == 1);
}

TEST_CASE("a connection made by an RTC or a tool is an act", "[openrtm][server]") {
    ServerRig rig;
    const RtcLink first{"controller.out", "Mouse0", "target_velocity_in"},
        made{"controller.in", "a.host_cxt/Out0", "out"};
    rig.server->joined(made);
    rig.server->joined(first);  // is there already
    rig.turn();
    CHECK(rig.acts.lines == std::vector<std::string>{"Connect by network rtm"});
    CHECK(rig.told.links == std::vector<RtcLink>{first, made});
    CHECK(rig.live->system().foreign_connections().back() ==
          ConnectionSpec{"rtm:a.host_cxt/Out0.out", "controller.in", {}});
    CHECK(rig.said_lines ==
          std::vector<std::string>{"connected by an RTC or a tool: rtm:a.host_cxt/Out0.out to controller.in"});
    rig.server->joined({"controller.in", "Out 0", "out"});
    rig.turn();
    CHECK(rig.told.links.size() == 2);
    CHECK(rig.said_lines.back() ==
          "an RTC or a tool has connected rtm:Out 0.out to controller.in, but the system can't show this "
          "connection: expected \"rtm:NAME.port\" or \"rtm:HOST.host_cxt/NAME.port\", got 'rtm:Out 0.out'");
}

TEST_CASE("connections between exported components are shown, and RTCs may change them", "[openrtm][server]") {
    ServerRig rig;
    CHECK(rig.told.inside.empty());
    RtcRequest request{.what = RtcRequest::What::connect,
                       .component = "controller",
                       .from = "controller.out",
                       .to = "mouse.target_velocity_in"};
    CHECK(rig.ask(request) == RtcAnswer::done);
    CHECK(rig.ask(request) == RtcAnswer::refused);
    CHECK(rig.told.inside == std::vector<RtcInside>{{"controller.out", "mouse.target_velocity_in"}});
    request.what = RtcRequest::What::disconnect;
    CHECK(rig.ask(request) == RtcAnswer::done);
    CHECK(rig.told.inside.empty());
    CHECK(rig.acts.lines.front() == "Connect by network rtm");
    CHECK(rig.acts.lines.back() == "Disconnect by network rtm");
}

TEST_CASE("RTCs get the time of day if robots are real, and simulated time otherwise", "[openrtm][server]") {
    const bool real_time = GENERATE(false, true);
    CAPTURE(real_time);
    ServerRig rig(exported_system, {.real_time = real_time});
    rig.told.wanted["controller.out"] = {.little = true};
    rig.turn(3);
    REQUIRE_FALSE(rig.told.sent.empty());
    Value value = Velocity2D{};
    double tm = 0;
    REQUIRE(read_cdr_message(rig.told.sent.back().second, value, tm));
    CHECK(tm == Approx(real_time ? time_of_test : 0.02).margin(0.05).epsilon(0));
}

TEST_CASE("a port that a new version of its script lacks loses its connection to an RTC", "[openrtm][server]") {
    ServerRig rig;
    std::string text = counter_behavior;
    text.replace(text.find("\"out\""), 5, "\"way\"");
    rig.folder.write("behaviors/counter.lua", text);
    REQUIRE(rig.live->act(Reload{.component = "controller", .text = text}, {Actor::Kind::console}));
    rig.turn();
    CHECK(rig.told.links.empty());
    CHECK(rig.told.profiles.size() == 2);
    REQUIRE_FALSE(rig.said_lines.empty());
    CHECK(
        rig.said_lines[0] ==
        "rtm: controller.out is no longer connected to rtm:Mouse0.target_velocity_in: connect: controller has no port "
        "'out'");
    const std::size_t said = rig.said_lines.size();
    REQUIRE(rig.live->act(Remove{"mouse"}, {Actor::Kind::console}));
    rig.turn();
    CHECK(rig.told.profiles.size() == 1);
    CHECK(rig.said_lines.size() == said);
}

TEST_CASE("a connection's malformed messages are reported once", "[openrtm][server]") {
    ServerRig rig;
    const std::vector<std::uint8_t> half{1, 2, 3};
    for (int i = 0; i < 3; ++i)
        CHECK(rig.server->put("controller.in", "Peer0", half, std::endian::little) == PutAnswer::malformed);
    rig.turn(2);
    REQUIRE(rig.said_lines.size() == 1);
    CHECK(rig.said_lines[0].starts_with("rtm: controller.in refuses a malformed message from connection 'Peer0': "));
    CHECK(rig.server->malformed() == 3);
}

TEST_CASE("without the module for CORBA the error has the location of the word rtm", "[openrtm][server]") {
    ServerRig rig;
    const auto opened = RtmServer::open(
        rig.host(), [](const OrbOptions&, RtcSite&) -> Expected<std::unique_ptr<Orb>> { return failure("not here"); });
    REQUIRE_FALSE(opened);
    CHECK(opened.error().message == "rtm: not here");
    CHECK(opened.error().place.line == 4);
}

TEST_CASE("the end of a server ends its exports", "[openrtm][server]") {
    ServerRig rig;
    rig.server.reset();
    CHECK(rig.told.ended);
}

TEST_CASE("an emergency stop sends zero to RTCs in every tick, until rearm", "[openrtm][server]") {
    ServerRig rig;
    rig.told.wanted["controller.out"] = {.little = true};
    const auto sent = [&] {
        rig.told.sent.clear();
        for (int i = 0; i < 3; ++i) {
            REQUIRE(rig.live->act(Write{"controller.out", Velocity2D{.vx = 0.25}}, {}));
            rig.turn();
        }
        std::vector<double> speeds;
        for (const auto& [path, bytes] : rig.told.sent) {
            if (path != "controller.out little") continue;
            Value value = Velocity2D{};
            double tm = 0;
            REQUIRE(read_cdr_message(bytes, value, tm, {.order = std::endian::little}));
            speeds.push_back(value.get<Velocity2D>().vx);
        }
        return speeds;
    };
    REQUIRE(rig.live->act(Deactivate{"controller"}, {}));
    rig.turn();
    CHECK(sent() == std::vector<double>{0.25, 0.25, 0.25});
    REQUIRE(rig.live->act(Stop{}, {}));
    CHECK(sent() == std::vector<double>{0, 0, 0});
    CHECK(rig.said_lines ==
          std::vector<std::string>{"rtm: emergency stop: RTCs connected to controller.out get speed 0 until rearm()",
                                   "rtm: the emergency stop does not reach rtm:Mouse0.target_velocity_in, which is "
                                   "not connected: stop it there"});
    rig.turn(100);
    REQUIRE(rig.live->act(Rearm{}, {}));
    CHECK(sent() == std::vector<double>{0.25, 0.25, 0.25});

    rig.said_lines.clear();
    rig.told.made = rig.told.links;
    REQUIRE(rig.live->act(Stop{}, {}));
    rig.turn();
    CHECK(rig.said_lines ==
          std::vector<std::string>{"rtm: emergency stop: RTCs connected to controller.out get speed 0 until rearm()"});
}

TEST_CASE("an emergency stop does not change a robot's measurements", "[openrtm][server]") {
    ServerRig rig;
    rig.told.wanted["mouse.current_velocity_out"] = {.little = true};
    REQUIRE(rig.live->act(Deactivate{"controller"}, {}));
    for (int i = 0; i < 30; ++i) {
        REQUIRE(rig.live->act(Inject{"mouse.target_velocity_in", Velocity2D{.vx = 0.25}}, {}));
        rig.turn();
    }
    REQUIRE(rig.live->act(Stop{}, {}));
    rig.told.sent.clear();
    rig.turn(2);
    REQUIRE(rig.told.sent.size() == 2);
    Value measured = Velocity2D{};
    double tm = 0;
    REQUIRE(read_cdr_message(rig.told.sent[0].second, measured, tm, {.order = std::endian::little}));
    CHECK(measured.get<Velocity2D>().vx > 0.1);
}

TEST_CASE("a component that a tool adds is exported and connects to RTCs, also when a saved file is run",
          "[openrtm][server]") {
    ServerRig rig;
    BehaviorEntry entry{.name = "second", .script = "counter"};
    entry.path = rig.folder.path("behaviors/counter.lua").string();
    REQUIRE(rig.live->act(Add{entry}, {Actor::Kind::console, "1"}));
    rig.turn();
    CHECK(rig.told.profiles.size() == 2);  // a person has added it, who has not exported it
    REQUIRE(rig.live->act(Remove{"second"}, {Actor::Kind::console, "1"}));
    REQUIRE(rig.live->act(Add{entry}, rtm_actor));
    rig.turn();
    REQUIRE(rig.told.profiles.size() == 3);
    CHECK(rig.told.profiles[2].component == "second");
    CHECK(rig.live->act(Connect{"rtm:Eye0.out", "second.in"}, rtm_actor));
    const SystemSpec& spec = rig.live->spec();
    CHECK(rtm_word().text(*spec.peers.at("rtm")) == "rtm { export = { \"mouse\", \"controller\", \"second\" } }\n");
    REQUIRE(rig.live->act(Restart{}, {}));
    rig.turn();
    CHECK(rig.told.profiles.size() == 2);  // those of the file
}

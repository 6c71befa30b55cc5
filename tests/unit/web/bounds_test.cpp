// Browsers that send too much, receive too little or send nonsense harm only themselves.
#include <catch2/catch.hpp>
#include <vector>

#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;

TEST_CASE("an invalid message is answered with its error", "[web][bounds]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto told = [&](const std::string& message) {
        REQUIRE(browser.send_frame(message));
        return browser.next_text("\"ok\":false");
    };
    CHECK(told("{").find("expected one JSON object") != std::string::npos);
    CHECK(told("[1]").find("expected one JSON object") != std::string::npos);
    CHECK(told("{}").find("'do' must be") != std::string::npos);
    CHECK(told(R"({"do":"dance"})").find("'do' must be one of watch, act, stop") != std::string::npos);
    CHECK(told(R"({"do":"act","id":"x"})").find("'id' must be a whole number") != std::string::npos);
    CHECK(told(R"({"do":"act","id":1,"act":"Explode"})")
              .find("there is no act (change of the running system) 'Explode'") != std::string::npos);
    CHECK(told(R"({"do":"act","id":1,"act":"Activate","fields":{"x":1}})").find("'component' is missing") !=
          std::string::npos);
    CHECK(told(R"({"do":"time","id":1,"what":"fly"})").find("'what' must be one of pause, resume") !=
          std::string::npos);
    CHECK(told(std::string(100'000, '[')).find("is nested too deeply") != std::string::npos);
    REQUIRE(browser.send_frame("\xff\xfe", 2));
    CHECK(browser.next_text("expected one JSON object") != "");
    CHECK(WebRig::answer(browser, {{"do", "rearm"}, {"id", 2}})["ok"] == false);
    CHECK(rig.component("controller").state() == LifeState::active);
}

TEST_CASE("a message that is too long closes only its connection", "[web][bounds]") {
    WebRig rig;
    RawBrowser good = rig.open(), bad = rig.open();
    const std::string piece(std::size_t{1} << 18, 'x');
    bool more = bad.send_frame(piece, 1, false);
    for (int i = 0; i < 8 && more; ++i) more = bad.send_frame(piece, 0, false);
    CHECK(bad.is_closed());
    CHECK(WebRig::answer(good, {{"do", "stop"}, {"id", 1}})["ok"] == true);
}

TEST_CASE("a browser that sends too many messages is closed", "[web][bounds]") {
    WebRig rig;
    RawBrowser good = rig.open(), bad = rig.open();
    bool more = true;
    for (int i = 0; i < 3000 && more; ++i) more = bad.send_frame(R"({"do":"watch"})");
    CHECK(bad.is_closed());
    CHECK(WebRig::answer(good, {{"do", "stop"}, {"id", 1}})["ok"] == true);
}

TEST_CASE("the number of browsers is limited", "[web][bounds]") {
    WebRig rig;
    std::vector<RawBrowser> browsers;
    for (std::size_t i = 0; i < web::most_clients; ++i) browsers.push_back(rig.open());
    RawBrowser one_more = rig.connect();
    const std::string head =
        one_more.ask(WebRig::upgrade(rig.host(), "http://" + rig.host(), "nezumi, token." + rig.token));
    REQUIRE(head.size() > 12);
    CHECK(head.substr(9, 3) == "503");
    CHECK(WebRig::answer(browsers.back(), {{"do", "stop"}, {"id", 1}})["ok"] == true);
}

TEST_CASE("a browser that does not receive delays neither the engine nor another browser", "[web][bounds]") {
    WebRig rig;
    rig.paused = false;
    RawBrowser deaf = rig.open(rig.token, 4096);
    REQUIRE(deaf.send_frame(R"({"do":"watch","ports":["controller.out"],"truth":true,"rays":true})"));
    RawBrowser good = rig.open();
    REQUIRE(good.send_frame(R"({"do":"watch","truth":true})"));
    // More than all queues and buffers hold.
    for (int i = 0; i < 200; ++i) {
        rig.server->log({.level = LogLevel::info, .text = std::string(40'000, 'x')});
        rig.serve();
    }
    CHECK(WebRig::answer(good, {{"do", "stop"}, {"id", 1}})["ok"] == true);
}

TEST_CASE("a request that never ends does not exclude other browsers", "[web][bounds]") {
    WebRig rig;
    std::vector<RawBrowser> slow;
    for (int i = 0; i < 20; ++i) {
        slow.push_back(rig.connect());
        REQUIRE(slow.back().put("GET / HTTP/1.1\r\nHost: 127"));
    }
    RawBrowser browser = rig.open();
    CHECK_FALSE(browser.next_text("hello").empty());
    RawBrowser long_one = rig.connect();
    const std::string head =
        long_one.ask("GET / HTTP/1.1\r\nHost: " + rig.host() + "\r\nX: " + std::string(100'000, 'x') + "\r\n");
    CHECK(head.rfind("HTTP/1.1 200", 0) != 0);
    CHECK(WebRig::answer(browser, {{"do", "stop"}, {"id", 1}})["ok"] == true);
}

TEST_CASE("any number of connections without a token does not exclude one with a token", "[web][bounds]") {
    WebRig rig;
    std::vector<RawBrowser> idle;
    for (int i = 0; i < 120; ++i) idle.push_back(rig.connect());
    std::vector<RawBrowser> browsers;
    for (int i = 0; i < 20; ++i) {
        browsers.push_back(rig.open());
        for (int more = 0; more < 5; ++more) idle.push_back(rig.connect());
    }
    for (RawBrowser& browser : browsers) CHECK(WebRig::answer(browser, {{"do", "stop"}, {"id", 1}})["ok"] == true);
    CHECK(idle.front().is_closed(3));  // the oldest
    const std::string head = rig.connect().ask("GET / HTTP/1.1\r\nHost: " + rig.host() + "\r\n");
    CHECK(head.rfind("HTTP/1.1 200", 0) == 0);
}

TEST_CASE("a connection without a token is closed after 5 s, also after a request for a file",
          "[web][bounds][wallclock]") {
    WebRig rig;
    const auto begin = std::chrono::steady_clock::now();
    RawBrowser idle = rig.connect(), half = rig.connect(), asked = rig.connect(), browser = rig.open();
    REQUIRE(half.put("GET / HTTP/1.1\r\nHost: 127"));
    CHECK(asked.ask("GET / HTTP/1.1\r\nHost: " + rig.host() + "\r\n").rfind("HTTP/1.1 200", 0) == 0);
    for (RawBrowser* each : {&idle, &half, &asked}) CHECK(each->is_closed(15));
    const auto lasted = std::chrono::steady_clock::now() - begin;
    CHECK(lasted > std::chrono::milliseconds(4500));
    CHECK(lasted < std::chrono::seconds(12));
    CHECK(WebRig::answer(browser, {{"do", "stop"}, {"id", 1}})["ok"] == true);
}

TEST_CASE("view-only browsers do not exclude browsers that may stop the robots", "[web][bounds]") {
    WebRig rig;
    std::vector<RawBrowser> browsers;
    for (std::size_t i = 0; i < web::most_viewers; ++i) browsers.push_back(rig.open(rig.view_token));
    RawBrowser one_more = rig.connect();
    const std::string head =
        one_more.ask(WebRig::upgrade(rig.host(), "http://" + rig.host(), "nezumi, token." + rig.view_token));
    REQUIRE(head.size() > 12);
    CHECK(head.substr(9, 3) == "503");
    RawBrowser acts = rig.open();
    CHECK(WebRig::answer(acts, {{"do", "stop"}, {"id", 1}})["ok"] == true);
}

TEST_CASE("browsers are informed at once when the run ends", "[web][bounds]") {
    WebRig rig;
    RawBrowser browser(rig.port, [] {});
    REQUIRE(browser.ask(WebRig::upgrade(rig.host(), "http://" + rig.host(), "nezumi, token." + rig.token)) != "");
    const auto begin = std::chrono::steady_clock::now();
    rig.server.reset();
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(5));
    CHECK_FALSE(browser.next_text("\"is\":\"bye\"").empty());
    CHECK(browser.is_closed());
}

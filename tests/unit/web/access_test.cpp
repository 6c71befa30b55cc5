// Access control: requests without the token, from another page or under another host name are refused.
#include "bindings/web/access.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

std::string status_of(WebRig& rig, const std::string& host, const std::string& origin, const std::string& protocols,
                      const std::string& path = "/ws") {
    RawBrowser browser = rig.connect();
    const std::string head = browser.ask(WebRig::upgrade(host, origin, protocols, path));
    return head.size() > 12 ? head.substr(9, 3) : head;  // behind "HTTP/1.1 "
}

}  // namespace

TEST_CASE("a page of this host with the token gets a WebSocket and a greeting", "[web][access]") {
    WebRig rig;
    RawBrowser browser = rig.connect();
    const std::string head =
        browser.ask(WebRig::upgrade(rig.host(), "http://" + rig.host(), "nezumi, token." + rig.token));
    CHECK(head.rfind("HTTP/1.1 101", 0) == 0);
    CHECK(head.find("Sec-WebSocket-Protocol: nezumi\r\n") != std::string::npos);
    CHECK(head.find(rig.token) == std::string::npos);
    const auto hello = WebRig::Json::parse(browser.next_text("hello"));
    CHECK(hello["is"] == "hello");
    CHECK(hello["you"] == "browser 1");
    CHECK(hello["view_only"] == false);
    CHECK(hello["version"] == "1.2.3");
}

TEST_CASE("without the token no WebSocket is opened", "[web][access]") {
    WebRig rig;
    const std::string origin = "http://" + rig.host();
    const auto status = [&](const std::string& protocols) { return status_of(rig, rig.host(), origin, protocols); };
    const std::string refused = "403";
    CHECK(status("") == refused);
    CHECK(status("nezumi") == refused);
    CHECK(status("nezumi, token.") == refused);
    CHECK(status("nezumi, token." + std::string(32, '0')) == refused);
    CHECK(status("nezumi, token." + rig.token.substr(1)) == refused);
    CHECK(status("nezumi, token." + rig.token + "0") == refused);
    CHECK(status("nezumi, token." + rig.token + ", token.x") == refused);
    CHECK(status("file, token." + rig.token) == refused);
    CHECK(status("token." + rig.token) == refused);
    CHECK(status("nezumi, " + rig.token) == refused);
    std::string upper = rig.token;
    for (char& each : upper) each = static_cast<char>(std::toupper(each));
    if (upper != rig.token) CHECK(status("nezumi, token." + upper) == refused);
    CHECK(status("nezumi, token." + rig.token) == "101");
}

TEST_CASE("a page of another origin, or without an origin, is refused even with the right token", "[web][access]") {
    WebRig rig;
    const std::string protocols = "nezumi, token." + rig.token, refused = "403";
    const auto status = [&](const std::string& origin) { return status_of(rig, rig.host(), origin, protocols); };
    CHECK(status("") == refused);
    CHECK(status("null") == refused);
    CHECK(status("http://example.com") == refused);
    CHECK(status("https://" + rig.host()) == refused);
    CHECK(status("http://" + rig.host() + ".example.com") == refused);
    CHECK(status("http://127.0.0.1:1") == refused);
    CHECK(status("http://localhost:" + std::to_string(rig.port)) == refused);
}

TEST_CASE("requests under another host name are refused, also for files", "[web][access]") {
    WebRig rig;
    const std::string protocols = "nezumi, token." + rig.token, refused = "403";
    for (const std::string host : {"example.com", "127.0.0.1.example.com", "example.com:8765", "127.0.0.2", "[::2]:1",
                                   "127.0.0.1:x", "127.0.0.1:", "127.0.0.1:123456"}) {
        INFO(host);
        CHECK(status_of(rig, host, "http://" + host, protocols) == refused);
        RawBrowser browser = rig.connect();
        CHECK(browser.ask("GET / HTTP/1.1\r\nHost: " + host + "\r\n").substr(9, 3) == refused);
    }
    CHECK(status_of(rig, "", "http://" + rig.host(), protocols) != "101");
    // A tunnel has its own port.
    CHECK(status_of(rig, "localhost:9000", "http://localhost:9000", protocols) == "101");
}

TEST_CASE("only /ws is a WebSocket", "[web][access]") {
    WebRig rig;
    const std::string origin = "http://" + rig.host(), protocols = "nezumi, token." + rig.token;
    for (const std::string path : {"/", "/ws/", "/WS", "/other", "/ws/../x"})
        CHECK(status_of(rig, rig.host(), origin, protocols, path) == "403");
}

TEST_CASE("tokens are long, random and hexadecimal, and compared whole", "[web][access]") {
    const std::string one = make_token(), other = make_token();
    CHECK(one.size() == 32);
    CHECK(one.find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(one != other);
    CHECK(is_same_secret("abc", "abc"));
    CHECK_FALSE(is_same_secret("abc", "abd"));
    CHECK_FALSE(is_same_secret("abc", "ab"));
    CHECK_FALSE(is_same_secret("", ""));
    CHECK_FALSE(is_same_secret("", "a"));
    const AccessControl access;
    CHECK(access.token() != access.view_token());
}

TEST_CASE("a view-only browser sees everything and can't act", "[web][access]") {
    WebRig rig;
    RawBrowser browser = rig.open(rig.view_token);
    CHECK(WebRig::Json::parse(browser.next_text("hello"))["view_only"] == true);
    for (const WebRig::Json& message :
         {WebRig::Json{{"do", "act"}, {"id", 1}, {"act", "Deactivate"}, {"fields", {{"component", "controller"}}}},
          WebRig::Json{{"do", "stop"}, {"id", 2}}, WebRig::Json{{"do", "time"}, {"id", 3}, {"what", "quit"}},
          WebRig::Json{{"do", "console"}, {"id", 4}, {"request", {{"do", "eval"}, {"text", "quit()"}}}},
          WebRig::Json{{"do", "drive"},
                       {"id", 5},
                       {"port", "mouse.target_velocity_in"},
                       {"value", {{"TimedVelocity2D", {{"vx", 1}, {"vy", 0}, {"va", 0}}}}}}}) {
        const auto answer = WebRig::answer(browser, message);
        CHECK(answer["ok"] == false);
        CHECK(answer["text"] == "this link is view-only");
    }
    rig.serve();
    CHECK(rig.component("controller").state() == LifeState::active);
    CHECK_FALSE(rig.live->system().is_stopped());
    CHECK_FALSE(rig.quitting);
    REQUIRE(browser.send_frame(R"({"do":"watch","truth":true})"));
    for (auto got = browser.next(); got && got->opcode != 2; got = browser.next()) {
        REQUIRE(got->opcode == 1);
    }
}

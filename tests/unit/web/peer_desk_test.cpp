// RTCs on the page: looked at while somebody shows them; requests are answered when the RTC has answered.
#include "bindings/web/peer_desk.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/web/web_rig.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

struct Desk {
    std::vector<std::promise<std::string>> looks{};
    std::vector<std::promise<Expected<std::string>>> asked{};
    std::vector<std::string> answers{};
    PeerDesk desk{{.look =
                       [this] {
                           looks.emplace_back();
                           return looks.back().get_future();
                       },
                   .ask =
                       [this](const PeerRequest&) {
                           asked.emplace_back();
                           return asked.back().get_future();
                       }},
                  [this](ClientId client, std::int64_t id, const Expected<void>& done) {
                      answers.push_back(std::to_string(client) + "/" + std::to_string(id) + " " +
                                        (done ? "done" : done.error().message));
                  }};
    PeerDesk::Clock::time_point now{std::chrono::hours(1)};

    std::optional<std::string> serve(bool is_watched, double after = 0) {
        now += std::chrono::duration_cast<PeerDesk::Clock::duration>(std::chrono::duration<double>(after));
        return desk.serve(is_watched && desk.is_due(now), now);
    }
};

}  // namespace

TEST_CASE("RTCs are looked at only while a browser shows them, once a second", "[web][peers]") {
    Desk desk;
    CHECK_FALSE(desk.serve(false));
    CHECK(desk.looks.empty());
    CHECK_FALSE(desk.serve(true));
    REQUIRE(desk.looks.size() == 1);
    CHECK_FALSE(desk.serve(true, 5));  // one question at a time
    CHECK(desk.looks.size() == 1);
    desk.looks[0].set_value("one");
    CHECK(desk.serve(true) == "one");
    CHECK_FALSE(desk.serve(true, 4));  // it took 5 s: time for the requests of people
    CHECK(desk.looks.size() == 1);
    CHECK_FALSE(desk.serve(true, 2));
    REQUIRE(desk.looks.size() == 2);
    desk.looks[1].set_value("one");
    CHECK_FALSE(desk.serve(true));  // nothing new
}

TEST_CASE("a request to an RTC is answered by its result, and the change is looked for at once", "[web][peers]") {
    Desk desk;
    REQUIRE(desk.desk.ask(1, 10, {}));
    REQUIRE(desk.desk.ask(2, 20, {}));
    desk.serve(true);
    desk.looks[0].set_value("before");
    CHECK(desk.serve(true) == "before");
    desk.asked[1].set_value(failure("its state does not allow that"));
    desk.serve(true);
    CHECK(desk.answers == std::vector<std::string>{"2/20 its state does not allow that"});
    desk.serve(true);
    CHECK(desk.looks.size() == 2);
    desk.asked[0].set_value("");
    desk.serve(true);
    CHECK(desk.answers.back() == "1/10 done");
}

TEST_CASE("requests to RTCs that hang are limited", "[web][peers]") {
    Desk desk;
    for (std::size_t i = 0; i < PeerDesk::most_waiting; ++i) REQUIRE(desk.desk.ask(1, 1, {}));
    const auto one_more = desk.desk.ask(1, 1, {});
    REQUIRE_FALSE(one_more);
    CHECK(one_more.error().message == "too many requests are already waiting");
}

TEST_CASE("a browser's request about RTCs is refused without RTCs, or with the error in it", "[web][peers]") {
    WebRig rig;
    RawBrowser browser = rig.open();
    const auto refused = [&](WebRig::Json message) {
        message["do"] = "peer";
        message["id"] = 1;
        const auto answer = WebRig::answer(browser, message);
        CHECK(answer["ok"] == false);
        return answer["text"].get<std::string>();
    };
    CHECK(refused({{"what", "activate"}, {"name", "In0"}}) == "this program can't reach RTCs: use `nezumi run`");
    CHECK(refused({{"what", "dance"}, {"name", "In0"}}) ==
          "'what' must be one of activate, deactivate, reset, use, configure, exit, forget, connect, disconnect");
    CHECK(refused({{"what", "activate"}}) == "'name' must be a string");
    CHECK(refused({{"what", "activate"}, {"name", ""}}) == "'name' must be a string");
    CHECK(refused({{"what", "use"}, {"name", "In0"}}) == "'set' must be a string");
    CHECK(refused({{"what", "connect"}, {"from", "Out0.out"}}) == "'to' must be a string");
    CHECK(refused({{"what", "configure"}, {"name", "In0"}, {"value", 1}}) == "'parameter' must be a string");
    CHECK(refused({{"what", "configure"}, {"name", "In0"}, {"parameter", "gain"}, {"value", nullptr}}) ==
          "'value' must be a number, a string, a boolean, or a list of one of these types");
}

TEST_CASE("a view-only browser asks nothing of RTCs", "[web][peers]") {
    WebRig rig;
    RawBrowser browser = rig.open(rig.view_token);
    const auto answer = WebRig::answer(browser, {{"do", "peer"}, {"id", 1}, {"what", "exit"}, {"name", "In0"}});
    CHECK(answer["text"] == "this link is view-only");
}

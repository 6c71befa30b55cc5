// Going back from the console: what a person can do while it is computed.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

TEST_CASE("a seek that is interrupted leaves the present as it is", "[console][past]") {
    SessionRig it;
    it.turn(10'000);
    const std::uint64_t now = it.live->trace_hash();
    it.shown.clear();
    it.session->submit("seek(99)");
    // As little as possible at a time: it has begun when it has paused time.
    while (it.moved == 0) it.session->advance(std::chrono::microseconds(0));
    it.session->interrupt();
    for (int rounds = 0; rounds < 100 && it.session->is_busy(); ++rounds) it.session->advance();
    CHECK(it.shown == "! interrupted");
    CHECK(it.live->trace_hash() == now);
    CHECK_FALSE(it.live->is_past());
    CHECK(it.type("now()") == "100.0");
}

TEST_CASE("a long seek shows how far it is, and Esc gives it up", "[console][past]") {
    SessionRig it;
    it.turn(30'000);
    const std::uint64_t now = it.live->trace_hash();
    it.session->submit("seek(299)");
    // Each turn computes a little, and much time passes.
    while (!it.keys && it.session->is_busy()) {
        it.session->advance(std::chrono::microseconds(0));
        std::this_thread::sleep_for(std::chrono::milliseconds(70));
    }
    REQUIRE(it.keys);
    CHECK(it.shown.find("%, Esc cancels") != std::string::npos);
    it.session->key(Key::escape);
    for (int rounds = 0; rounds < 100 && it.session->is_busy(); ++rounds) it.session->advance();
    CHECK(it.shown.find("! interrupted") != std::string::npos);
    CHECK_FALSE(it.keys);
    CHECK(it.live->trace_hash() == now);
    CHECK_FALSE(it.live->is_past());
}

TEST_CASE("a step of another console ends when time goes back", "[console][past]") {
    SessionRig it;
    it.turn(200);
    it.session->submit("step(100) print('stepped')");
    for (int rounds = 0; rounds < 1000 && !it.is_advancing(); ++rounds) it.session->advance();
    it.turn(10);
    REQUIRE(it.live->act(Seek{.tick = 50}, {Actor::Kind::browser, "1"}));
    it.shown.clear();
    for (int rounds = 0; rounds < 1000 && it.session->is_busy(); ++rounds) it.session->advance();
    CHECK(it.shown.find("another console has stopped, moved or restarted time") != std::string::npos);
}

TEST_CASE("with real robots nothing goes back", "[console][past]") {
    SessionRig it;
    it.hardware = true;
    SessionOptions options;
    std::string said;
    options.output.show_error = [&](std::string_view text) { said += text; };
    options.bell = &it.bell;
    it.session = std::move(Session::create(*it.live, it, std::move(options)).value());
    it.session->submit("rewind(1)");
    for (int rounds = 0; rounds < 1000 && it.session->is_busy(); ++rounds) it.session->advance();
    CHECK(said.find("real robots can't go back in time") != std::string::npos);
}

// Consoles share a system's time between ticks, and each has what it asked for.
#include "bindings/console/server.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "bindings/console/client.hpp"
#include "bindings/lua/reload/lua_host.hpp"
#include "tests/unit/console/session_rig.hpp"

using namespace nezumi;

namespace {

using Clock = ConsoleServer::Clock;

// This thread's own time [s]: what others do on the machine is not ours.
double worked() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

struct ServerRig : SessionRig {
    ConsoleClient open(ConsoleServer::Use use = ConsoleServer::Use::prompt) {
        auto socket = server.connect(use);
        REQUIRE(socket);
        return ConsoleClient(std::move(*socket));
    }
    void serve(double seconds = 0.001) {
        const double begin = worked();
        const auto slice = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
        server.serve(Clock::now() + slice);
        longest = std::max(longest, worked() - begin);
        if (is_advancing()) {
            turn();
            server.after_tick();
        }
    }
    // What a client is told until the answer, "!" before errors, and at the end how it went.
    std::vector<std::string> ask(ConsoleClient& client, Request request) {
        const std::int64_t id = client.send(std::move(request));
        return until_answer(client, id);
    }
    std::vector<std::string> eval(ConsoleClient& client, const std::string& text) {
        return ask(client, {.kind = Request::Kind::eval, .text = text});
    }
    std::vector<std::string> until_answer(ConsoleClient& client, std::int64_t id) {
        std::vector<std::string> said;
        const auto end = Clock::now() + std::chrono::seconds(20);
        while (Clock::now() < end) {
            serve();
            while (const auto event = client.next(1)) {
                if (event->kind == Event::Kind::completions && event->id == id) return event->items;
                if (event->kind == Event::Kind::keys) said.emplace_back(event->ok ? "keys" : "no keys");
                if (event->kind == Event::Kind::log) said.push_back(event->level + " " + event->text);
                if (event->kind == Event::Kind::output) said.push_back(event->text);
                if (event->kind == Event::Kind::error) said.push_back("!" + event->text);
                if (event->kind != Event::Kind::answer || event->id != id) continue;
                said.emplace_back(event->ok ? "well" : "failed");
                return said;
            }
        }
        said.emplace_back("no answer");
        return said;
    }

    ConsoleServer server{*live, *this};
    double longest = 0;  // [s] of a `serve`
};

using Said = std::vector<std::string>;

}  // namespace

TEST_CASE("a console answers each request with its success", "[console][server]") {
    ServerRig it;
    ConsoleClient client = it.open();
    CHECK(it.eval(client, "1 + 2") == Said{"3", "well"});
    CHECK(it.eval(client, "x = = 1") == Said{"!unexpected symbol near '='", "failed"});
    CHECK(it.ask(client, {.kind = Request::Kind::is_complete, .text = "for i = 1, 3 do"}) == Said{"failed"});
    CHECK(it.ask(client, {.kind = Request::Kind::is_complete, .text = "1"}) == Said{"well"});
    CHECK(it.ask(client, {.kind = Request::Kind::complete, .text = "controller.sta", .cursor = 14}) ==
          Said{"state", "status"});
}

TEST_CASE("each console has variables of its own and sees the same system", "[console][server]") {
    ServerRig it;
    ConsoleClient one = it.open();
    ConsoleClient other = it.open();
    CHECK(it.eval(one, "x = 1; controller.config.speed_x = 0.2") == Said{"well"});
    CHECK(it.eval(other, "x") == Said{"!unknown name 'x'", "failed"});
    CHECK(it.eval(other, "controller.config.speed_x") == Said{"0.2", "well"});
}

TEST_CASE("an endless loop does not block other consoles, and ends with a message", "[console][server][watchdog]") {
    ServerRig it;
    ConsoleClient endless = it.open();
    ConsoleClient other = it.open();
    const std::int64_t id = endless.send({.kind = Request::Kind::eval, .text = "while true do end"});
    it.serve();
    for (int count = 0; count < 5; ++count) CHECK(it.eval(other, "1 + 1") == Said{"2", "well"});
    endless.send({.kind = Request::Kind::interrupt, .text = {}});
    CHECK(it.until_answer(endless, id) == Said{"!interrupted", "failed"});
    CHECK(it.eval(endless, "2") == Said{"2", "well"});
}

TEST_CASE("no turn takes much longer than its limit", "[console][server][wallclock][watchdog]") {
    ServerRig it;
    ConsoleClient endless = it.open();
    endless.send({.kind = Request::Kind::eval, .text = "while true do local s = ('x'):rep(1000) .. 'y' end"});
    it.eval(endless, "1");  // the session is made and has begun
    it.longest = 0;
    std::vector<double> turns;
    for (int count = 0; count < 300; ++count) {
        it.longest = 0;
        it.serve(0.001);
        turns.push_back(it.longest);
    }
    std::sort(turns.begin(), turns.end());
    CHECK(turns[turns.size() * 9 / 10] < 0.0015);
}

TEST_CASE("the work of a client that has left is stopped", "[console][server][watchdog]") {
    ServerRig it;
    ConsoleClient client = it.open();
    ConsoleClient other = it.open();
    client.send({.kind = Request::Kind::eval, .text = "while true do end"});
    it.serve();
    it.eval(other, "1");
    client.close();
    for (int count = 0; count < 100; ++count) it.serve();
    CHECK_FALSE(it.server.serve(Clock::now() + std::chrono::milliseconds(1)));
    CHECK(it.eval(other, "1") == Said{"1", "well"});
}

TEST_CASE("log lines are sent to clients that asked for them", "[console][server]") {
    ServerRig it;
    ConsoleClient silent = it.open();
    ConsoleClient curious = it.open();
    curious.send({.kind = Request::Kind::hello, .text = {}, .log = true});
    it.eval(curious, "1");
    it.server.log({.level = LogLevel::warn, .seconds = 1.5, .component = "mouse", .text = "slow"});
    CHECK(it.eval(curious, "2") == Said{"warn [    1.500] warn  mouse: slow", "2", "well"});
    CHECK(it.eval(silent, "2") == Said{"2", "well"});
}

TEST_CASE("keys are sent to the session that drives, and driving without keys is refused", "[console][server]") {
    ServerRig it;
    ConsoleClient without = it.open();
    CHECK(it.eval(without, "drive 'mouse'") == Said{"!drive: this needs a terminal, because it reads keys", "failed"});
    ConsoleClient with = it.open();
    with.send({.kind = Request::Kind::hello, .text = {}, .keys = true});
    const Said driven = it.eval(with, "drive 'mouse'");
    CHECK(driven.front() == "keys");
    CHECK(driven.back() == "well");
    with.send({.kind = Request::Kind::key, .text = "up"});
    CHECK(it.eval(with, "step(2) return mouse.target_velocity_in.value.vx > 0").front() == "true");
    with.send({.kind = Request::Kind::key, .text = "escape"});
    CHECK(it.eval(with, "1") == Said{"no keys", "1", "well"});
}

TEST_CASE("step waits for its ticks, and the rest of the line follows", "[console][server]") {
    ServerRig it;
    ConsoleClient client = it.open(ConsoleServer::Use::batch);
    const double before = it.live->system().now().seconds;
    CHECK(it.eval(client, "step(5)").back() == "well");
    CHECK(it.live->system().now().seconds - before == Approx(0.05));
    CHECK(it.eval(client, "run()").back() == "failed");
}

TEST_CASE("a line with much output waits for its client, loses nothing, and other consoles continue",
          "[console][server]") {
    ServerRig it;
    ConsoleClient late = it.open();
    ConsoleClient other = it.open();
    constexpr int lines = 40'000;
    const std::int64_t id =
        late.send({.kind = Request::Kind::eval,
                   .text = "for i = 1, " + std::to_string(lines) + " do print(i, ('x'):rep(60)) end"});
    // A full output is not work: the loop that ticks need not come back for it.
    bool works = true;
    for (int turns = 0; turns < 20'000 && works; ++turns)
        works = it.server.serve(Clock::now() + std::chrono::milliseconds(1)) || turns < 10;
    CHECK_FALSE(works);
    CHECK(it.eval(other, "1 + 1") == Said{"2", "well"});
    const Said said = it.until_answer(late, id);
    REQUIRE(said.size() == lines + 1);
    CHECK(said[lines - 1].starts_with(std::to_string(lines) + "\t"));
    CHECK(said.back() == "well");
}

TEST_CASE("a line that waits for a client that never reads ends with an interrupt", "[console][server]") {
    ServerRig it;
    ConsoleClient client = it.open();
    client.send({.kind = Request::Kind::eval, .text = "while true do print(('x'):rep(1000)) end"});
    for (int turns = 0; turns < 300; ++turns) it.serve();
    const std::int64_t interrupt = client.send({.kind = Request::Kind::interrupt, .text = {}});
    const Said said = it.until_answer(client, interrupt - 1);
    CHECK(said.back() == "failed");
    CHECK(it.eval(client, "1 + 1") == Said{"2", "well"});
}

TEST_CASE("a wait ends with an error if another console controls time", "[console][server]") {
    const std::string other = GENERATE("step(5)", "run(0.1)", "run(30)", "pause()", "run()", "restart()");
    ServerRig it;
    ConsoleClient waiting = it.open();
    ConsoleClient acting = it.open();
    const std::string wait = GENERATE("step(50)", "run(0.5)");
    const std::int64_t id =
        waiting.send({.kind = Request::Kind::eval, .text = wait + " print('as if nothing had been')"});
    for (int turns = 0; turns < 10'000 && !it.is_advancing(); ++turns) it.serve();
    for (int ticks = 0; ticks < 16; ++ticks) it.serve();
    INFO(wait << " beside " << other);
    it.eval(acting, other);
    CHECK(it.until_answer(waiting, id) ==
          Said{"!" + wait.substr(0, wait.find('(')) +
                   ": interrupted: another console has stopped, moved or restarted time",
               "failed"});
}

TEST_CASE("a wait that is over is not ended by the next command of another console", "[console][server]") {
    ServerRig it;
    ConsoleClient waiting = it.open();
    const std::int64_t id = waiting.send({.kind = Request::Kind::eval, .text = "step(5)"});
    for (int turns = 0; turns < 10'000 && !it.is_advancing(); ++turns) it.serve();
    it.turn(static_cast<int>(it.left));
    it.resume();
    CHECK(it.until_answer(waiting, id) == Said{"well"});
}

TEST_CASE("each console has its own log level", "[console][server]") {
    ServerRig it;
    ConsoleClient quiet = it.open();
    ConsoleClient usual = it.open();
    for (ConsoleClient* client : {&quiet, &usual})
        client->send({.kind = Request::Kind::hello, .text = {}, .log = true});
    CHECK(it.eval(quiet, "log_level 'error'") == Said{"well"});
    CHECK(it.eval(usual, "1") == Said{"1", "well"});
    it.server.log({LogLevel::debug, 1, "it", "d"});
    it.server.log({LogLevel::info, 1, "it", "i"});
    it.server.log({LogLevel::error, 1, "it", "e"});
    CHECK(it.eval(quiet, "1") == Said{"error [    1.000] error it: e", "1", "well"});
    CHECK(it.eval(usual, "1") == Said{"info [    1.000] info  it: i", "error [    1.000] error it: e", "1", "well"});
    CHECK(it.eval(usual, "log_level 'debug'") == Said{"well"});
    it.server.log({LogLevel::debug, 2, "it", "d"});
    CHECK(it.eval(usual, "1") == Said{"debug [    2.000] debug it: d", "1", "well"});
}

TEST_CASE("the actor of a console does not change after its first act", "[console][server]") {
    ServerRig it;
    std::optional<ConsoleClient> client(it.open());
    CHECK(it.eval(*client, "hold('mouse.target_velocity_in', { vx = 0.1 })") == Said{"well"});
    client->send({.kind = Request::Kind::hello, .text = {}, .who = "spreadsheet"});
    CHECK(it.eval(*client, "1") == Said{"1", "well"});
    const auto holder = [&] { return it.live->system().holder("mouse.target_velocity_in"); };
    REQUIRE(holder() != nullptr);
    CHECK(holder()->kind == Actor::Kind::console);
    client.reset();  // the hold of a spreadsheet would go with it
    ConsoleClient other = it.open();
    CHECK(it.eval(other, "1") == Said{"1", "well"});
    CHECK(holder() != nullptr);
}

TEST_CASE("holds on a real robot end with the last console, those of a spreadsheet always, velocities with zero",
          "[console][server][safety]") {
    ServerRig it;
    LiveOptions options;
    options.scripts = &lua_scripts();
    options.installed = {source_root()};
    options.world = sim::make_world;
    const std::string who = GENERATE("", "spreadsheet");
    const bool real = GENERATE(true, false);
    CAPTURE(who, real);
    options.build.real_time = real;
    auto loaded = RunningSystem::load(it.file, options);
    REQUIRE(loaded);
    RunningSystem& live = **loaded;
    ConsoleServer server(live, it);
    std::optional<ConsoleClient> one(std::move(*server.connect(ConsoleServer::Use::prompt)));
    std::optional<ConsoleClient> other(std::move(*server.connect(ConsoleServer::Use::prompt)));
    const auto holder = [&] { return live.system().holder("mouse.target_velocity_in"); };
    const auto serve = [&](std::chrono::milliseconds patience, bool until_held) {
        const auto end = Clock::now() + patience;
        while (Clock::now() < end && (holder() != nullptr) != until_held) {
            server.serve(Clock::now() + std::chrono::milliseconds(1));
            live.tick();
        }
        return (holder() != nullptr) == until_held;
    };
    for (auto* client : {&one, &other}) (*client)->send({.kind = Request::Kind::hello, .text = {}, .who = who});
    one->send({.kind = Request::Kind::eval, .text = "hold('mouse.target_velocity_in', { vx = 0.1 })"});
    REQUIRE(serve(std::chrono::seconds(20), true));
    one.reset();
    CHECK_FALSE(serve(std::chrono::milliseconds(200), false));  // all consoles of a user are one
    other.reset();
    const bool ends = real || !who.empty();
    CHECK(serve(std::chrono::milliseconds(ends ? 20'000 : 200), false) == ends);
}

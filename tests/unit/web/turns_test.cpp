// The queue for the shared system of a class.
#include "bindings/web/classroom/turns.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "bindings/web/classroom/shared_system.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

using namespace nezumi;
using namespace nezumi::web;

namespace {

using std::chrono::minutes;
using std::chrono::seconds;

const auto everybody_is_there = [](int) { return true; };

}  // namespace

TEST_CASE("pupils drive in the order in which they have come, each once", "[web][class]") {
    Turns turns;
    const auto now = Turns::Clock::now();
    CHECK_FALSE(turns.begin(now));
    for (const int pupil : {3, 1, 2, 1}) turns.enter(pupil);
    CHECK(turns.place_of(3) == 1);
    CHECK(turns.place_of(2) == 3);
    CHECK(turns.place_of(7) == 0);
    REQUIRE(turns.begin(now));
    CHECK(turns.driver() == 3);
    CHECK_FALSE(turns.begin(now));
    turns.enter(3);
    CHECK(turns.place_of(3) == 0);
    turns.move_up(2);
    turns.move_up(2);
    CHECK(turns.waiting() == std::deque<int>{2, 1});
    turns.remove(2);
    turns.end();
    CHECK(turns.left(now) == seconds(0));
    REQUIRE(turns.begin(now));
    CHECK(turns.driver() == 1);
}

TEST_CASE("a turn ends when its time is up, also when the limit changes meanwhile", "[web][class]") {
    Turns turns;
    const auto now = Turns::Clock::now();
    turns.enter(1);
    REQUIRE(turns.begin(now));
    CHECK(turns.left(now) == minutes(5));
    CHECK_FALSE(turns.look(now + minutes(5) - seconds(1), everybody_is_there));
    CHECK(turns.look(now + minutes(5), everybody_is_there));
    turns.set_limit(minutes(2));
    CHECK(turns.look(now + minutes(2), everybody_is_there));
    for (const minutes wrong : {minutes(0), minutes(-1), Turns::longest_limit + minutes(1)}) turns.set_limit(wrong);
    CHECK(turns.limit() == minutes(2));
}

TEST_CASE("a pupil who is away for long gives up the turn and the place, not one who comes back", "[web][class]") {
    Turns turns;
    const auto now = Turns::Clock::now();
    for (const int pupil : {1, 2, 3}) turns.enter(pupil);
    REQUIRE(turns.begin(now));
    const auto later = now + Turns::longest_absence + seconds(1);
    std::set<int> there{3};
    const auto is_there = [&](int pupil) { return there.count(pupil) != 0; };
    CHECK_FALSE(turns.look(now, is_there));
    there.insert(1);
    CHECK_FALSE(turns.look(now + seconds(5), is_there));
    CHECK_FALSE(turns.look(later, is_there));
    CHECK(turns.waiting() == std::deque<int>{3});
    there.erase(1);
    CHECK_FALSE(turns.look(later, is_there));
    CHECK(turns.look(later + Turns::longest_absence + seconds(1), is_there));
}

TEST_CASE("the shared system runs in a copy without exercises, which is made again", "[web][class]") {
    const Scratch scratch;
    scratch.write("mine/behaviors/systems/arena.lua", "arena {}");
    scratch.write("mine/behaviors/driver.lua", "-- the teacher's");
    scratch.write("mine/behaviors/exercises/drive/hidden/tests/x_test.lua", "secret");
    scratch.write("mine/tests/shown_test.lua", "-- a scenario");
    auto shared = SharedSystem::open({.file = scratch.path("mine/behaviors/systems/arena.lua")}, scratch.path("copy"));
    REQUIRE(shared);
    CHECK((*shared)->name() == "arena");
    CHECK((*shared)->file() == scratch.path("copy/behaviors/systems/arena.lua"));
    CHECK_FALSE(std::filesystem::exists(scratch.path("copy/behaviors/exercises")));
    CHECK_FALSE(std::filesystem::exists(scratch.path("copy/tests")));
    scratch.write("copy/behaviors/driver.lua", "-- a pupil's");
    scratch.write("copy/behaviors/more.lua", "-- a pupil's");
    REQUIRE((*shared)->renew());
    CHECK(text_of_file(scratch.path("copy/behaviors/driver.lua")) == "-- the teacher's");
    CHECK_FALSE(std::filesystem::exists(scratch.path("copy/behaviors/more.lua")));
}

TEST_CASE("a system file outside of a project can't be shared", "[web][class]") {
    const Scratch scratch;
    scratch.write("mine/behaviors/driver.lua", "");
    scratch.write("mine/arena.lua", "arena {}");
    const auto shared = SharedSystem::open({.file = scratch.path("mine/arena.lua")}, scratch.path("copy"));
    REQUIRE_FALSE(shared);
    CHECK(describe(shared.error()) ==
          scratch.path("mine/arena.lua").string() +
              ": is not within behaviors/ of a project: make one with nezumi new project NAME");
}

TEST_CASE("a pupil's behaviours replace those that run, but no system file, and not through links", "[web][class]") {
    const Scratch scratch;
    scratch.write("mine/behaviors/systems/arena.lua", "arena {}");
    scratch.write("mine/behaviors/driver.lua", "-- the teacher's");
    auto shared = SharedSystem::open({.file = scratch.path("mine/behaviors/systems/arena.lua")}, scratch.path("copy"));
    REQUIRE(shared);
    const auto describe_script = [&](const std::string& script) {
        (*shared)->view.take(
            {.kind = RelayFrame::Kind::text,
             .client = 0,
             .bytes = R"({"is":"system","components":[{"state":"ACTIVE","script":")" + script + "\"}]}"});
    };
    describe_script(scratch.path("copy/behaviors/driver.lua").string());
    scratch.write("pupil/behaviors/other.lua", "-- a module");
    const auto none = (*shared)->take_behaviors(scratch.path("pupil"));
    REQUIRE_FALSE(none);
    CHECK(none.error().message == "no file of yours is a behaviour of this system, which runs driver.lua");
    CHECK_FALSE(std::filesystem::exists(scratch.path("copy/behaviors/other.lua")));
    scratch.write("secret.lua", "-- of another one");
    scratch.write("pupil/behaviors/driver.lua", "-- the pupil's");
    scratch.write("pupil/behaviors/systems/arena.lua", "robot 'x' {}");
    std::filesystem::create_symlink(scratch.path("secret.lua"), scratch.path("pupil/behaviors/link.lua"));
    const auto taken = (*shared)->take_behaviors(scratch.path("pupil"));
    REQUIRE(taken);
    CHECK(*taken == 2);
    CHECK(text_of_file(scratch.path("copy/behaviors/driver.lua")) == "-- the pupil's");
    CHECK(text_of_file(scratch.path("copy/behaviors/other.lua")) == "-- a module");
    CHECK(text_of_file(scratch.path("copy/behaviors/systems/arena.lua")) == "arena {}");
    CHECK_FALSE(std::filesystem::exists(scratch.path("copy/behaviors/link.lua")));
    CHECK(*(*shared)->take_behaviors(scratch.path("pupil")) == 0);
}

// `nezumi test --hw` on the fake robots: the scenarios of the simulation, at real time.
#include <catch2/catch.hpp>
#include <fstream>

#include "hw/rig/rig_world.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_ev3_rig.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

const std::string front_of_wall = "0.8";  // the middle of the wall of stop_at_wall.lua

struct Mouse : FakeMouse {
    explicit Mouse(const std::vector<std::string>& more = {}) : FakeMouse(more) {
        folder.write("behaviors/none.lua", "param('x', 1)");
        folder.write("behaviors/ahead.lua",
                     "local out = output('out', 'TimedVelocity2D')\n"
                     "param('vx', 0.1)\n"
                     "function on_execute() out:write { vx = config.vx } end\n");
        folder.write("ahead.lua",
                     "robot 'mouse' { model = 'raspimouse' }\n"
                     "behavior 'driver' { script = 'ahead' }\n"
                     "connect('driver.out', 'mouse.target_velocity_in')\n");
    }
    Outcome test(const std::string& scenarios, const std::vector<std::string>& more, bool with_rig = true) {
        folder.write("it_test.lua", scenarios);
        std::vector<std::string> words{"test", "it_test.lua", "--hw", "--dev-root", dev()};
        if (with_rig) words.insert(words.end(), {"--rig", "mouse=" + socket_path()});
        words.insert(words.end(), more.begin(), more.end());
        return run_nezumi(std::move(words), folder.path("").string());
    }
};

std::string scenario(const std::string& body) { return "scenario('it', function(s)\n" + body + "\nend)\n"; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// The seminar's scenarios of a file, on fakes; the truth comes from the fakes.
Outcome seminar(const std::string& file, const std::string& filter, const std::string& rig, const std::string& dev,
                const std::string& sys) {
    std::vector<std::string> words{"test", "tests/scenarios/" + file, "--filter", filter, "--hw", "--rig", rig};
    if (!dev.empty()) words.insert(words.end(), {"--dev-root", dev});
    if (!sys.empty()) words.insert(words.end(), {"--sys-root", sys});
    const Scratch failures;
    words.insert(words.end(), {"-o", failures.path("").string()});
    return run_nezumi(std::move(words));
}

}  // namespace

TEST_CASE("a scenario of the simulation passes on the mouse, at real time", "[hw][test][fakes][wallclock]") {
    Mouse fake({front_of_wall});
    const double begin = clock_seconds();
    const Outcome run = seminar("robot_controller_test.lua", "stops in front of the wall at every speed [speed=0.2]",
                                "mouse=" + fake.socket_path(), fake.dev(), "");
    INFO(run.out << run.error);
    CHECK(run.status == 0);
    CHECK(has(run.out, "1 passed"));
    CHECK(clock_seconds() - begin > 5);
    CHECK(fake.truth().position.x > 0.5);
    CHECK_FALSE(fake.motion().power);
}

TEST_CASE("without a rig a scenario that needs truth, collisions or pushes is refused in one line",
          "[hw][test][fakes][wallclock]") {
    Mouse fake;
    const std::string why =
        "mouse is a real robot, whose true pose is not known: run this in simulation, or give --rig mouse=SOCKET";
    for (const std::string body :
         {"s:load 'ahead.lua' s:always('x', function() return s.mouse.truth.pose.position.x < 9 end) s:run(1)",
          "s:load 'ahead.lua' s:never('x', function() return s.mouse.collided end) s:run(1)",
          "s:load 'ahead.lua' s:disturb('mouse', { vx = 0.1 })", "s:load 'ahead.lua' s:press('mouse', 'switch0')",
          "s:load 'ahead.lua' s:teleport('mouse', { x = 1, y = 0, heading = 0 })"}) {
        INFO(body);
        const Outcome run = fake.test(scenario(body), {}, false);
        INFO(run.out << run.error);
        CHECK(run.status == 2);
        CHECK(has(run.out, why));
    }
    CHECK(fake.truth().position.x < 0.05);
}

TEST_CASE("without a rig a scenario that uses only ports runs, and then the robot stands",
          "[hw][test][fakes][wallclock]") {
    Mouse fake;
    const Outcome run = fake.test(scenario("local world = s:load 'ahead.lua'\n"
                                           "s:wait_until('under way', { within = 3 }, function() return "
                                           "world.mouse.current_velocity_out.value.vx > 0.09 end)\n"
                                           "s:check(s:now() > 0.15 and s:now() < 3, 'real time passes')\n"
                                           "s:run(0.5)\n"),
                                  {}, false);
    INFO(run.out << run.error);
    CHECK(run.status == 0);
    CHECK(fake.truth().position.x > 0.04);
    CHECK_FALSE(fake.moves());
    CHECK_FALSE(fake.motion().power);
}

TEST_CASE("a failure on the robot is reported with the command that repeats it, and is not repeated automatically",
          "[hw][test][fakes][wallclock]") {
    Mouse fake;
    const Outcome run =
        fake.test(scenario("local world = s:load 'ahead.lua'\n"
                           "s:always('stays', function() return world.mouse.truth.pose.position.x < 0.05 end)\n"
                           "s:run(5)\n"),
                  {"-o", fake.folder.path("failures").string()});
    INFO(run.out << run.error);
    CHECK(run.status == 1);
    CHECK(has(run.out, "always 'stays' held until"));
    CHECK(has(run.out, "--seed 124 --hw --rig mouse=" + fake.socket_path()));
    CHECK(has(run.out, "trace.csv"));
    CHECK(fake.truth().position.x < 0.12);  // a second run would have started at 0 and come as far
    CHECK(std::count_if(std::filesystem::recursive_directory_iterator(fake.folder.path("failures")), {},
                        [](const auto& entry) { return entry.path().filename() == "trace.csv"; }) == 1);
}

TEST_CASE("a rig moves the robot back before each run, pushes it, presses its buttons and reports its contacts",
          "[hw][test][fakes][wallclock]") {
    Mouse fake({"0.3"});
    const Outcome run = fake.test(
        "scenario('begins again', { sweep = { turn = { 1, 2 } } }, function(s, p)\n"
        "  local world = s:load 'ahead.lua'\n"
        "  s:check(world.mouse.truth.pose.position.x < 0.01, 'put back')\n"
        "  s:run(1)\n"
        "  s:check(world.mouse.truth.pose.position.x > 0.04, 'drove')\n"
        "end)\n"
        "scenario('is handled', function(s)\n"
        "  local world = s:load 'ahead.lua'\n"
        "  world.driver.config.vx = 0\n"
        "  s:run(0.2)\n"
        "  s:press('mouse', 'switch0', 0.5)\n"
        "  s:eventually('pressed', { within = 0.4 }, function() return world.mouse.switch3bit_out.value[1] end)\n"
        "  s:eventually('let go', { within = 1.5 }, function() return not world.mouse.switch3bit_out.value[1] end)\n"
        "  s:disturb('mouse', { vx = 0.1, seconds = 0.5 })\n"
        "  s:run(1)\n"
        "  s:near(world.mouse.truth.pose.position.x, 0.05, 0.02)\n"
        "  s:teleport('mouse', { x = -1, y = 0.5, heading = 1 })\n"
        "  s:near(world.mouse.truth.pose.heading, 1, 0.01)\n"
        "  s:teleport('mouse', { x = 0, y = 0, heading = 0 })\n"
        "  s:check(not world.mouse.collided, 'touches nothing')\n"
        "  world.driver.config.vx = 0.2\n"
        "  s:eventually('is there', { within = 4 }, function() return world.mouse.collided end)\n"
        "  s:check(world.mouse.touching == 'box 1', world.mouse.touching)\n"
        "  local ok, message = pcall(function() s:teleport('mouse', { x = 0.3, y = 0, heading = 0 }) end)\n"
        "  s:check(not ok and tostring(message):find('the rig of', 1, true), message)\n"
        "end)\n",
        {});
    INFO(run.out << run.error);
    CHECK(run.status == 0);
    CHECK(has(run.out, "3 passed"));
}

TEST_CASE("requests impossible for real robots are refused before anything moves", "[hw][test][fakes][wallclock]") {
    Mouse fake;
    const std::string two = "scenario('a', { sweep = { x = { 1, 2 } } }, function(s) s:load 'ahead.lua' s:run(1) end)";
    const Outcome sweep = fake.test(two, {}, false);
    CHECK(sweep.status == 2);
    CHECK(sweep.error ==
          "nezumi: --hw: these are 2 runs, and the robots are not moved back between them: choose one by --filter "
          "(--list "
          "shows their names), or give --rig\n");
    const Outcome repeat = fake.test(two, {"--repeat", "2"});
    CHECK(repeat.status == 2);
    CHECK(repeat.error == "nezumi: --hw: two runs of a real robot always differ: leave out --repeat\n");
    const Outcome golden = fake.test(scenario("s:load 'ahead.lua' s:golden('x.csv', 'mouse.current_pose_out')"), {});
    CHECK(golden.status == 2);
    CHECK(has(golden.out, "'x.csv': two runs of a real robot always differ: use this only in simulation"));
    const Outcome second = fake.test(scenario("s:load 'ahead.lua' s:load 'ahead.lua'"), {});
    CHECK(second.status == 2);
    CHECK(has(second.out, "with --hw a scenario can have only one world: remove the second world"));
    const Outcome none = fake.test(scenario("s:behavior('b', { script = 'none' }) s:run(1)"), {});
    CHECK(none.status == 2);
    CHECK(has(none.out, "has no robot or device that can be real"));
    CHECK(fake.truth().position.x < 0.01);
}

TEST_CASE("a missing or silent rig is reported and ends the run", "[hw][test][fakes][wallclock]") {
    Mouse fake;
    const std::string looks = scenario(
        "local world = s:load 'ahead.lua' s:always('x', function() return world.mouse.truth.pose.position.x < 9 end) "
        "s:run(20)");
    fake.folder.write("it_test.lua", looks);
    const std::vector<std::string> words{"test", "it_test.lua", "--hw", "--dev-root", fake.dev(), "--rig"};
    auto with = [&](const std::string& rig) {
        auto all = words;
        all.push_back(rig);
        return run_nezumi(std::move(all), fake.folder.path("").string());
    };
    const Outcome gone = with("mouse=nobody");
    CHECK(gone.status == 2);
    CHECK(has(gone.out, "--rig: mouse: nobody: No such file or directory"));
    const Outcome slip = with("mouse");
    CHECK(slip.status == 2);
    CHECK(slip.error == "nezumi: --rig: expected a socket for each robot as in mouse=mouse.socket, got 'mouse'\n");
    const Outcome without_robot =
        run_nezumi({"test", "it_test.lua", "--rig", "mouse=x"}, fake.folder.path("").string());
    CHECK(without_robot.status == 2);
    CHECK(without_robot.error == "nezumi: --rig is for real robots: give --hw as well\n");
}

TEST_CASE("the seminar's scenarios of the mouse pass on the fake mouse", "[.seminar][hw][fakes]") {
    Mouse fake({front_of_wall});
    // At a lower speed it stops where the sensor gives 30 or 31, and moves to and fro between the two.
    const std::string stops = "stops in front of the wall at every speed ";
    for (const std::string& filter :
         {stops + "[speed=0.1]", stops + "[speed=0.2]", stops + "[speed=0.3]", stops + "[speed=0.5]",
          std::string("drives on when the way is free again"), std::string("backs away from the wall")}) {
        const Outcome run = seminar("robot_controller_test.lua", filter, "mouse=" + fake.socket_path(), fake.dev(), "");
        INFO(run.out << run.error);
        CHECK(run.status == 0);
    }
}

TEST_CASE("the seminar's scenarios of both robots pass on the fake ones", "[.seminar][hw][fakes]") {
    FakeMouse mouse;
    FakeEv3 ev3;
    const std::string rig = "mouse=" + mouse.socket_path() + ",ev3=" + ev3.socket_path();
    const auto test = [&](const std::string& file, const std::string& filter) {
        const Outcome run = seminar(file, filter, rig, mouse.dev(), ev3.roots().sys);
        INFO(run.out << run.error);
        CHECK(run.status == 0);
    };
    test("touch_sensor_test.lua", "the EV3's touch sensors drive the mouse");
    test("touch_sensor_test.lua", "a mouse whose touch sensors fall silent stops");
    test("joystick_test.lua", "one joystick drives both robots at once");
    test("joystick_test.lua", "a joystick that falls silent stops both robots");
    test("ev3_test.lua", "the mouse goes as far as the EV3 that a hand rolls, and turns as much");
    test("speech_test.lua", "several texts of one moment are all spoken, in order");
}

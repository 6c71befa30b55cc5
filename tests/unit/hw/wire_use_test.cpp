// A rover whose driver is a behaviour: its mistakes, its console, its scenarios.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "tests/unit/file_text.hpp"
#include "tests/unit/hw/own_sockets.hpp"
#include "tests/unit/hw/rover_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

TEST_CASE("an error of a driver is reported once, with the expected value", "[hw][wire][run][wallclock]") {
    RoverRun run;
    run.folder.write("behaviors/rover.lua",
                     "return robot_model { mass = 1, drive = { radius = 0.03, track = 0.1 }, sensors = { left = { kind "
                     "= 'range', at = { 0, 0.05, 0 } }, right = { kind = 'range', at = { 0, -0.05, 0 } } }, ports = { "
                     "ranges = { type = 'TimedDoubleSeq', from = { 'left', 'right' } } }, hardware = { script = "
                     "'rover_driver', devices = { line = serial { path = '/dev/ttyACM0', ends = '\\n', safe = 'v 0 "
                     "0\\n' } } } }");
    std::string wrong, expected;
    SECTION("a message that is too long") {
        wrong = "line_out:write(('x'):rep(2000))";
        expected = "rover_line: a message of 2000 bytes was dropped: expected at most 1024";
    }
    SECTION("more messages than the device takes") {
        run.rover->hang(true);
        wrong = "for _ = 1, 5 do line_out:write(('x'):rep(1000)) end";
        expected = "rover_line: it takes messages more slowly than they come: the oldest are dropped";
    }
    SECTION("pulses of three wheels") {
        wrong = "pulses:write { 1, 2, 3 }";
        expected = "driver_wheel_pulses: expected the pulses of two wheels, left and right, got 3 (reported once)";
    }
    SECTION("pulses that jump") {
        wrong = "pulses:write { now() < 1 and 0 or 1000000000, 0 }";
        expected = "the wheels' pulses jumped: the odometry ignores the jump";
    }
    SECTION("one value for two sensors") {
        wrong = "ranges:write { 1 }";
        expected = "driver_ranges: expected 2 values, got 1 (reported once)";
    }
    run.folder.write("behaviors/rover_driver.lua",
                     "local pulses = output('wheel_pulses', 'TimedLongSeq')\n"
                     "local ranges = output('ranges', 'TimedDoubleSeq')\n"
                     "local line_out = output('line_out', 'TimedString')\n"
                     "function on_execute() " +
                         wrong + " end\n");
    run.start();
    const bool is_said = run.program->wait_for_error(expected, 20);
    INFO(run.program->error);
    CHECK(is_said);
}

TEST_CASE("pause, emergency stop and reload of a driver stop its rover, and it drives on afterwards",
          "[hw][wire][run][safety][wallclock]") {
    const OwnSockets own;
    RoverRun run;
    run.copy("behaviors/rover_driver.lua", "behaviors/rover_driver.lua");
    run.get_going();
    const auto say = [&](const std::string& line) {
        const auto done = run_nezumi({"attach", "--eval", line}, run.folder.path("").string());
        INFO(line << ": " << done.out << done.error);
        CHECK(done.status == 0);
        return done.out + done.error;
    };
    const auto drives = [&] { return holds_within(5, [&] { return run.rover->speed() > 0.19; }); };

    say("pause()");
    CHECK(run.stands_within(0.2));
    CHECK(run.rover->last_line() == "v 0 0");
    say("run()");
    CHECK(drives());

    // It brakes within its limits, then only the safe bytes reach it.
    const std::size_t before = run.rover->lines().size();
    say("stop()");
    CHECK(run.stands_within(1));
    CHECK(holds_within(1, [&] { return run.rover->last_line() == "v 0 0"; }));
    const auto lines = run.rover->lines();
    const auto slower =
        std::count_if(lines.begin() + static_cast<std::ptrdiff_t>(before), lines.end(),
                      [](const auto& each) { return each.text.size() > 5 && each.text.starts_with("v 0.1"); });
    CHECK(slower > 3);
    const std::size_t silent = run.rover->lines().size();
    usleep(300000);
    CHECK(run.rover->lines().size() == silent);

    // The driver reloads now that the rover stands, and only then.
    const std::string driver = text_of_file(source_root() + "/behaviors/rover_driver.lua");
    run.folder.write("behaviors/rover_driver.lua", driver + "\nlog.info('the second version')\n");
    const std::string reloaded = say("reload()");
    INFO(reloaded);
    CHECK(reloaded.find("moves") == std::string::npos);
    CHECK(run.program->wait_for_error("the second version", 5));
    // A version that can't be loaded changes nothing.
    run.folder.write("behaviors/rover_driver.lua", driver + "\nthis is no Lua\n");
    const auto broken = run_nezumi({"attach", "--eval", "reload()"}, run.folder.path("").string());
    INFO(broken.out << broken.error);
    CHECK((broken.out + broken.error).find("rover_driver.lua:") != std::string::npos);
    say("rearm()");
    CHECK(drives());
    run.folder.write("behaviors/rover_driver.lua", driver + "\nlog.info('the third version')\n");
    const auto refused = run_nezumi({"attach", "--eval", "reload()"}, run.folder.path("").string());
    INFO(refused.out << refused.error);
    CHECK((refused.out + refused.error)
              .find("rover_driver drives 'rover', which moves: reload it when the robot stands still") !=
          std::string::npos);
    CHECK(run.rover->speed() > 0.19);
    CHECK(run.rover->torn_lines().empty());
}

TEST_CASE("a new driver that fails while its rover stands is replaced by the one before, and the rover never moves",
          "[hw][wire][run][safety][wallclock]") {
    const OwnSockets own;
    RoverRun run;
    run.copy("behaviors/rover_driver.lua", "behaviors/rover_driver.lua");
    run.get_going();
    const auto says = [&](const std::string& line) {
        return run_nezumi({"attach", "--eval", line}, run.folder.path("").string()).status == 0;
    };
    REQUIRE(says("stop()"));
    REQUIRE(run.stands_within(1));
    const std::size_t before = run.rover->lines().size();
    std::string driver = text_of_file(source_root() + "/behaviors/rover_driver.lua");
    const std::string begin = "function on_execute()";
    driver.insert(driver.find(begin) + begin.size(), " error('a wheel is missing') ");
    run.folder.write("behaviors/rover_driver.lua", driver);
    CHECK(holds_within(5, [&] { return says("reload()"); }));  // it is refused while the robot moves
    const bool is_back = run.program->wait_for_error("back to version 1 in rover_driver", 10);
    INFO(run.program->error);
    CHECK(is_back);
    CHECK(run.program->error.find("version 2 failed in its execution 1") != std::string::npos);
    CHECK(run.program->error.find("a wheel is missing") != std::string::npos);
    const auto lines = run.rover->lines();
    CHECK(std::all_of(lines.begin() + static_cast<std::ptrdiff_t>(before), lines.end(),
                      [](const auto& each) { return each.text == "v 0 0" || each.text == "v 0.000 0.000"; }));
    CHECK(says("rearm()"));
    CHECK(holds_within(5, [&] { return run.rover->speed() > 0.19; }));
    CHECK(run.rover->torn_lines().empty());
}

TEST_CASE("scenarios run on a real rover whose driver is a behaviour", "[hw][wire][test][wallclock]") {
    RoverRun run;
    run.folder.write("it_test.lua", R"(
scenario("drives ahead", function(s)
  local world = s:load "system.lua"
  s:run(2)
  s:near(world.rover.current_velocity_out.value.vx, 0.2, 0.05)
end)
)");
    const auto done = run_nezumi({"test", "it_test.lua", "--hw", "--dev-root", run.folder.path("dev").string()},
                                 run.folder.path("").string());
    INFO(done.out << done.error);
    CHECK(done.status == 0);
    const auto lines = run.rover->lines();
    CHECK(std::any_of(lines.begin(), lines.end(), [](const auto& each) { return each.text == "v 0.200 0.000"; }));
    CHECK(run.stands_within(0.1));
}

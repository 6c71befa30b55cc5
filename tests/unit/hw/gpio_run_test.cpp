// GPIO lines and PWM channels: what the kernel is asked for, and a robot that is driven by them.
#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <string>

#include "engine/devices/gpio_message.hpp"
#include "tests/unit/hw/board_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

const std::string pin_driver = R"(
local target = input("target_velocity_in", "TimedVelocity2D")
local velocity = output("current_velocity_out", "TimedVelocity2D")
local distance = output("distance", "TimedDouble")
local pins_in = input("pins_in", "TimedString", nil, { queue = 100 })
local pins_out = output("pins_out", "TimedString")
local echo, rose = false, 0
function on_execute()
  while pins_in.is_new do
    local line, level, tm = pins_in:read():match("^(%d+)=(%d) (%S+)$")
    if level == "1" then rose = tonumber(tm) end
    if level == "0" and rose > 0 then distance:write((tonumber(tm) - rose) * 171.5) end
  end
  echo = not echo
  velocity:write(target:read())
  pins_out:write(("23=%d 5=%d pwm0=%.3f"):format(echo and 1 or 0, target:read().vx > 0 and 1 or 0, target:read().vx))
end
)";

const std::string pin_watch = R"(
local distance = input("in", "TimedDouble")
function on_execute()
  if distance.is_new and not state.said then
    state.said = true
    log.info(("measured %.3f m"):format(distance:read()))
  end
end
)";

struct PinRun : BoardRun {
    PinRun() {
        board->add("gpiochip0");
        // An ultrasonic range finder: 0.6 m away. It answers when its trigger falls.
        board->on_output([this](std::int64_t line, bool level) {
            if (line != 23 || level) return;
            const double now = clock_seconds();
            board->edge(24, true, now - 0.004);
            board->edge(24, false, now - 0.004 + 0.6 / 171.5);
        });
        for (const char* file : {"period", "duty_cycle", "enable"})
            folder.write("sys/class/pwm/pwmchip0/pwm0/" + std::string(file), "0");
        write_robot(
            "pins = gpio { outputs = { 23, 5 }, inputs = { 24 }, pwm_channels = { 0 }, pwm_frequency = 1000, safe = "
            "'23=0 5=0 pwm0=0' }");
        write_driver(pin_driver);
        folder.write("behaviors/ear.lua", pin_watch);
        folder.write("system.lua",
                     "robot 'rover' { model = 'rover' }\n"
                     "behavior 'ahead' { script = 'ahead' }\n"
                     "behavior 'ear' { script = 'ear' }\n"
                     "connect('rover.distance', 'ear.in')\n"
                     "connect('ahead.target', 'rover.target_velocity_in')\n");
    }
    std::string content(const std::string& file) const {
        std::ifstream stream(folder.path("sys/class/pwm/pwmchip0/pwm0/" + file));
        std::string text;
        std::getline(stream, text);
        return text;
    }
    bool goes_ahead() {
        return goes([&] { return board->level(5) && content("duty_cycle") == "200000"; });
    }
};

}  // namespace

TEST_CASE("a robot drives by GPIO lines and PWM, and measures an echo by the times of its edges",
          "[hw][wire][run][wallclock]") {
    PinRun run;
    const bool goes = run.goes_ahead();
    INFO(run.program->error);
    REQUIRE(goes);
    CHECK(run.content("period") == "1000000");
    CHECK(run.content("enable") == "1");
    CHECK(run.program->wait_for_error("measured 0.600 m", 5));
    const auto all = run.board->transactions();
    REQUIRE(all.size() > 2);
    CHECK(all[0] == "gpiochip0 outputs 23 5 at 0 by nezumi");
    CHECK(all[1] == "gpiochip0 inputs 24 with both edges by nezumi");
    run.program->send(SIGINT);
    CHECK(run.program->wait() == 0);
    CHECK_FALSE(run.board->level(5));
    CHECK(run.content("duty_cycle") == "0");
}

TEST_CASE("inputs have the resistors and the debounce time that their robot gives", "[hw][wire][run][wallclock]") {
    PinRun run;
    const std::string pull = GENERATE("up", "down");
    run.write_robot("pins = gpio { outputs = { 23, 5 }, inputs = { 24 }, pull = '" + pull +
                    "', debounce = 0.005, pwm_channels = { 0 }, pwm_frequency = 50, safe = '23=0 5=0 pwm0=0' }");
    REQUIRE(run.goes([&] { return run.board->level(5); }));
    CHECK(run.content("period") == "20000000");
    const auto all = run.board->transactions();
    REQUIRE(all.size() > 1);
    CHECK(all[1] == "gpiochip0 inputs 24 with both edges pulled " + pull + " debounced 5000 us by nezumi");
}

TEST_CASE("when the engine is killed, lines and channels get their safe levels", "[hw][wire][run][safety][wallclock]") {
    PinRun run;
    REQUIRE(run.goes_ahead());
    const double begin = clock_seconds();
    run.program->send(SIGKILL);
    CHECK(holds_within(0.25, [&] { return !run.board->level(5) && run.content("duty_cycle") == "0"; }));
    WARN("the safe levels came " << (clock_seconds() - begin) * 1e3 << " ms after the engine's end");
}

TEST_CASE("a GPIO device that can't be used is refused by one line", "[hw][wire][run][wallclock]") {
    PinRun run;
    std::string device = "outputs = { 23, 5 }, safe = '23=0 5=0'", expected;
    SECTION("without anything") {
        device = "safe = false";
        expected = "robot_model: device 'pins': expected inputs, outputs or pwm_channels";
    }
    SECTION("with a line that has no safe level") {
        device = "outputs = { 23, 5 }, safe = '23=0'";
        expected = "robot_model: device 'pins': safe: output 5 has no level: add 5=0 or 5=1";
    }
    SECTION("with a channel that has no safe duty") {
        device = "outputs = { 23 }, pwm_channels = { 1 }, safe = '23=0'";
        expected = "robot_model: device 'pins': safe: pwm_channel 1 has no duty cycle: add pwm1=0";
    }
    SECTION("with another line among the safe ones") {
        device = "outputs = { 23 }, safe = '23=0 6=1'";
        expected = "robot_model: device 'pins': safe: '6=1': 6 is not one of outputs (23)";
    }
    SECTION("with a line twice") {
        device = "outputs = { 23 }, inputs = { 23 }, safe = '23=0'";
        expected = "robot_model: device 'pins': GPIO line 23 is given twice";
    }
    SECTION("with a line in use") {
        run.board->take_line(5);
        expected = "gpiochip0: outputs 23, 5: another program or driver uses one of them (gpioinfo shows it)";
    }
    SECTION("without the chip") {
        device += ", chip = 4";
        expected = "gpiochip4: no such file or directory: is there such a chip? ls /dev/gpiochip*";
    }
    SECTION("without the channel's chip") {
        device = "pwm_channels = { 1 }, pwm_chip = 2, safe = 'pwm1=0'";
        expected =
            "pwmchip2/pwm1: No such file or directory: is the PWM overlay loaded, and does the chip have this channel?";
    }
    run.write_robot("pins = gpio { " + device + " }");
    const std::string refusal = run.refusal();
    INFO(refusal);
    CHECK(refusal.find(expected) != std::string::npos);
}

TEST_CASE("a message for a line that is not an output is dropped and reported", "[hw][wire][run][wallclock]") {
    PinRun run;
    run.write_driver(
        "local pins_out = output('pins_out', 'TimedString')\nfunction on_execute() pins_out:write('24=1') end\n");
    run.start();
    CHECK(
        run.program->wait_for_error("rover_pins: a message was dropped: '24=1': 24 is not one of outputs (23, 5)", 20));
}

TEST_CASE("a PWM channel is driven by one program only", "[hw][wire][run][wallclock]") {
    PinRun run;
    REQUIRE(run.goes_ahead());
    const FakeBoard::Environment environment(run.folder.path("dev").string());
    Program second(run.words(), run.folder.path("").string());
    CHECK(second.wait() == 2);
    INFO(second.error);
    CHECK(second.error.find("pwmchip0: another program (process ") != std::string::npos);
    CHECK(run.content("duty_cycle") == "200000");
}

TEST_CASE("messages of GPIO are words with a line and its level", "[hw][wire]") {
    const std::vector<std::int64_t> lines{23, 24}, channels{0};
    const auto read = [&](const std::string& text) { return read_gpio_message(text, {lines, channels}); };
    const auto both = read(" 23=1  pwm0=0.25 ");
    REQUIRE(both);
    REQUIRE(both->size() == 2);
    CHECK((*both)[0].number == 23);
    CHECK((*both)[0].value == 1);
    CHECK((*both)[1].is_pwm);
    CHECK((*both)[1].value == 0.25);
    CHECK(read("23").error() == "'23': expected LINE=LEVEL, such as 23=1, or pwmCHANNEL=DUTY, such as pwm0=0.25");
    CHECK(read("x=1").error() == "'x=1': expected LINE=LEVEL, such as 23=1, or pwmCHANNEL=DUTY, such as pwm0=0.25");
    CHECK(read("22=1").error() == "'22=1': 22 is not one of outputs (23, 24)");
    CHECK(read("pwm1=1").error() == "'pwm1=1': 1 is not one of pwm_channels (0)");
    CHECK(read("pwm0=1.5").error() == "'pwm0=1.5': expected a duty from 0 to 1");
    CHECK(read("pwm0=nan").error() == "'pwm0=nan': expected a duty from 0 to 1");
    CHECK(read("24=2").error() == "'24=2': expected the level 0 or 1");
}

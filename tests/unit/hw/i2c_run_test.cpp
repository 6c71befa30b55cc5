// Devices on an I2C bus: the transactions that the kernel is asked for, and a robot that is driven by them.
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "tests/unit/file_text.hpp"
#include "tests/unit/hw/board_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// A motor driver at 0x60: register 06 is the speed in hundredths; FD stops all.
const std::string hat_devices =
    "hat = i2c { address = 0x60, registers = { 0x00, 0x10 }, lengths = { 1, 2 }, every = 0.02, safe = '\\xFD\\x10' }";

const std::string hat_driver = R"(
local target = input("target_velocity_in", "TimedVelocity2D")
local velocity = output("current_velocity_out", "TimedVelocity2D")
local hat_in = input("hat_in", "TimedOctetSeq", nil, { queue = 100 })
local hat_out = output("hat_out", "TimedOctetSeq")
function on_execute()
  while hat_in.is_new do
    local bytes = hat_in:read()
    if bytes == "\x10\x12\x34" and not state.said then
      state.said = true
      log.info("register 10 has 2 bytes")
    end
  end
  local speed = target:read()
  velocity:write(speed)
  hat_out:write("\x06" .. string.char(math.floor(speed.vx * 100 + 0.5)))
end
)";

struct HatRun : BoardRun {
    HatRun() {
        board->add("i2c-1");
        board->add_i2c(0x60);
        board->set_registers(0x60, 0x10, "\x12\x34");
        write_robot(hat_devices);
        write_driver(hat_driver);
    }
    bool goes_ahead() {
        return goes([&] { return board->register_of(0x60, 6) == 20; });
    }
    std::string last_written() const {
        const auto all = board->transactions();
        const auto is_writing = [](const std::string& each) { return each.find(" r ") == std::string::npos; };
        const auto found = std::find_if(all.rbegin(), all.rend(), is_writing);
        return found == all.rend() ? "" : *found;
    }
};

}  // namespace

TEST_CASE("a robot drives by the registers of a device on I2C, and reads others every period",
          "[hw][wire][run][wallclock]") {
    HatRun run;
    const bool goes = run.goes_ahead();
    INFO(run.program->error);
    REQUIRE(goes);
    CHECK(run.program->wait_for_error("register 10 has 2 bytes", 5));
    const auto all = run.board->transactions();
    REQUIRE(all.size() > 4);
    CHECK(all[0] == "60 r 1");  // does it answer?
    CHECK(std::find(all.begin(), all.end(), "60 w FD 10") != all.end());
    CHECK(std::find(all.begin(), all.end(), "60 w 10 r 2") != all.end());
    CHECK(std::find(all.begin(), all.end(), "60 w 06 14") != all.end());
    run.program->send(SIGINT);
    CHECK(run.program->wait() == 0);
    CHECK(run.last_written() == "60 w FD 10");
}

TEST_CASE("each register on I2C has its own period, and its number may have two bytes", "[hw][wire][run][wallclock]") {
    HatRun run;
    const bool is_big = GENERATE(true, false);
    run.board->add_i2c(0x29, 2);
    run.write_driver("local range_in = input('range_in', 'TimedOctetSeq', nil, { queue = 100 })\n" + hat_driver);
    run.write_robot(hat_devices +
                    ", range = i2c { address = 0x29, registers = { 0x0110, 0x0220 }, lengths = { 2, 1 }, periods = { "
                    "0.02, 0.4 }, number_bytes = 2, order = '" +
                    (is_big ? "big" : "little") + "', safe = false }");
    const auto count = [&](const std::string& transaction) {
        const auto all = run.board->transactions();
        return std::count(all.begin(), all.end(), transaction);
    };
    const std::string often = is_big ? "29 w 01 10 r 2" : "29 w 10 01 r 2";
    const std::string rarely = is_big ? "29 w 02 20 r 1" : "29 w 20 02 r 1";
    REQUIRE(run.goes([&] { return count(rarely) >= 3; }));
    // 0.8 s have passed: 40 periods, fewer on a busy machine, which skips them.
    CHECK(count(often) > 6);
    CHECK(count(often) < 65);
}

TEST_CASE("when the engine is killed, a device on I2C gets its safe bytes", "[hw][wire][run][safety][wallclock]") {
    HatRun run;
    REQUIRE(run.goes_ahead());
    const double begin = clock_seconds();
    run.program->send(SIGKILL);
    REQUIRE(holds_within(0.25, [&] { return run.last_written() == "60 w FD 10"; }));
    WARN("the safe bytes came " << (clock_seconds() - begin) * 1e3 << " ms after the engine's end");
    usleep(100000);
    CHECK(run.last_written() == "60 w FD 10");
}

TEST_CASE("a transaction that fails is tried again, and a device that stops answering stops the robot",
          "[hw][wire][run][wallclock]") {
    HatRun run;
    REQUIRE(run.goes_ahead());
    run.board->disturb(2);
    usleep(200000);
    run.board->set_answers(0x60, false);
    REQUIRE(run.program->wait_for_error("rover_hat: ", 5));
    run.program->listen(0.1);
    INFO(run.program->error);
    CHECK(run.program->error.find("i2c-1: no answer from address 0x60: look at its wires, its power and its address "
                                  "(i2cdetect)") != std::string::npos);
    CHECK(std::count(run.program->error.begin(), run.program->error.end(), '\n') <= 2);
    const std::size_t before = run.board->transactions().size();
    run.board->set_answers(0x60, true);
    CHECK(holds_within(5, [&] { return run.board->register_of(0x60, 6) == 20 && run.last_written() == "60 w 06 14"; }));
    CHECK(run.program->wait_for_error("rover_hat: back again", 5));
    // First it is stopped.
    const auto all = run.board->transactions();
    const auto first = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(before), all.end(),
                                    [](const std::string& each) { return each.find(" r ") == std::string::npos; });
    REQUIRE(first != all.end());
    CHECK(*first == "60 w FD 10");
}

TEST_CASE("a bus that hangs is reported, and its robot drives on when it works again", "[hw][wire][run][wallclock]") {
    HatRun run;
    REQUIRE(run.goes_ahead());
    run.board->hang(true);
    CHECK(run.program->wait_for_error("rover_hat: no answer for 0.3 s: restart its driver, or the robot", 5));
    run.board->hang(false);
    CHECK(run.program->wait_for_error("rover_hat: back again", 5));
    CHECK(holds_within(5, [&] { return run.last_written() == "60 w 06 14"; }));
}

TEST_CASE("a device on I2C that can't be used is refused by one line", "[hw][wire][run][wallclock]") {
    HatRun run;
    std::string device = "bus = 1, address = 0x60, safe = '\\xFD\\x10'", expected;
    SECTION("without an address") {
        device = "safe = '\\xFD\\x10'";
        expected = "robot_model: device 'hat': address: expected the device's address on the bus, such as 0x40";
    }
    SECTION("without the length of a register") {
        device += ", registers = { 0, 2 }, lengths = { 1 }";
        expected =
            "robot_model: device 'hat': lengths: expected the number of bytes of each of the 2 registers, got 1 "
            "numbers";
    }
    SECTION("with a register's number that is too large") {
        device += ", registers = { 300 }, lengths = { 1 }";
        expected =
            "robot_model: device 'hat': registers: 300 does not fit in a byte: expected at most 255, or "
            "number_bytes = 2";
    }
    SECTION("without the period of a register") {
        device += ", registers = { 0, 2 }, lengths = { 1, 1 }, periods = { 0.1 }";
        expected = "robot_model: device 'hat': periods: expected the period of each of the 2 registers, got 1 numbers";
    }
    SECTION("without safe bytes") {
        device = "address = 0x60";
        expected = "component 'rover_hat': --hw needs the device's safe bytes";
    }
    SECTION("without an answer") {
        run.board->set_answers(0x60, false);
        expected = "i2c-1: no answer from address 0x60: look at its wires";
    }
    SECTION("used by the kernel") {
        run.board->take_by_kernel(0x60);
        expected = "i2c-1 at 0x60: a driver of the kernel uses it";
    }
    SECTION("without the bus") {
        device = "bus = 3, address = 0x60, safe = '\\xFD\\x10'";
        expected = "i2c-3: no such file or directory: is I2C on? On a Raspberry Pi: sudo raspi-config nonint do_i2c 0";
    }
    SECTION("another device of the machine") {
        std::filesystem::create_symlink("/dev/null", run.folder.path("dev/null"));
        device = "path = '/dev/null', address = 0x60, safe = '\\xFD\\x10'";
        expected = "/null: it is not an I2C bus: expected a device such as /dev/i2c-1";
    }
    SECTION("a plain file of the machine") {
        run.folder.write("precious.txt", "precious");
        device = "path = '" + run.folder.path("precious.txt").string() + "', address = 0x60, safe = '\\xFD\\x10'";
        expected = "precious.txt: it is not an I2C bus";
    }
    run.write_robot("hat = i2c { " + device + " }");
    const std::string refusal = run.refusal();
    INFO(refusal);
    CHECK(refusal.find(expected) != std::string::npos);
}

TEST_CASE("the doctor examines the devices of a system's robots, and sends nothing to them", "[hw][wire][run]") {
    HatRun run;
    std::string device = "bus = 1, address = 0x60, safe = '\\xFD\\x10'", found = "ok     rover_hat: can be used\n";
    SECTION("all is well") {}
    SECTION("without an answer") {
        run.board->set_answers(0x60, false);
        found = "i2c-1: no answer from address 0x60: look at its wires, its power and its address (i2cdetect)\n";
    }
    SECTION("without the kernel's module") {
        run.folder.write("sys/bus/i2c/devices/i2c-3/name", "bcm2835");
        device = "bus = 3, address = 0x60, safe = '\\xFD\\x10'";
        found = "i2c-3: the module i2c-dev is not loaded: sudo modprobe i2c-dev\n";
    }
    SECTION("without the bus") {
        device = "bus = 4, address = 0x60, safe = '\\xFD\\x10'";
        found = "i2c-4: no such file or directory: is I2C on? On a Raspberry Pi: sudo raspi-config nonint do_i2c 0\n";
    }
    run.write_robot("hat = i2c { " + device + " }");
    const FakeBoard::Environment environment(run.folder.path("dev").string());
    const Outcome outcome =
        run_nezumi({"doctor", run.folder.path("system.lua").string(), "--dev-root", run.folder.path("dev").string(),
                    "--sys-root", run.folder.path("sys").string()});
    INFO(outcome.out + outcome.error);
    CHECK(outcome.out.find(found) != std::string::npos);
    CHECK((outcome.out.find("wrong  rover_hat: ") == std::string::npos) == found.starts_with("ok"));
    CHECK(outcome.out.find("neither a Raspberry Pi Mouse") == std::string::npos);
    for (const std::string& each : run.board->transactions()) CHECK(each.find(" w ") == std::string::npos);
}

TEST_CASE("the doctor says what to do where a user may not use the devices of a robot", "[hw][wire][run]") {
    if (geteuid() == 0 && access("/usr/bin/setpriv", X_OK) != 0)
        throw std::runtime_error("SKIPPED: root may use everything, and setpriv is not installed");
    BoardRun run;
    run.write_driver("function on_execute() end");
    run.write_robot(
        "hat = i2c { bus = 2, address = 0x60, safe = '\\1' }, line = serial { path = '/dev/ttyACM0', safe = '\\n' }, "
        "adc = spi { bus = 0, chip_select = 0, safe = '\\1' }, pins = gpio { outputs = { 23 }, safe = '23=0' }");
    for (const char* node : {"i2c-2", "ttyACM0", "spidev0.0", "gpiochip0"}) {
        run.folder.write(std::string("dev/") + node, "");
        chmod(run.folder.path(std::string("dev/") + node).c_str(), 0);
    }
    std::filesystem::permissions(run.folder.path(""), std::filesystem::perms(0755));
    const std::string out = run.folder.path("out").string();
    const std::string command = std::string(geteuid() == 0 ? "setpriv --reuid=65534 --clear-groups " : "") +
                                nezumi_program() + " doctor " + run.folder.path("system.lua").string() +
                                " --dev-root " + run.folder.path("dev").string() + " --sys-root " +
                                run.folder.path("sys").string() + " >" + out + " 2>&1";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 1);
    const std::string text = text_of_file(out);
    INFO(text);
    const std::map<std::string, std::string> groups{
        {"i2c-2", "i2c"}, {"ttyACM0", "dialout"}, {"spidev0.0", "spi"}, {"gpiochip0", "gpio"}};
    for (const auto& [node, group] : groups) {
        std::string expected = run.folder.path("dev/" + node).string();
        expected += ": permission denied: add this user to the group ";
        expected += group;
        expected += ": sudo adduser $USER ";
        expected += group;
        expected += ", then log in again\n";
        CHECK(text.find(expected) != std::string::npos);
    }
}

TEST_CASE("a plain file in place of an I2C bus has the last message", "[hw][wire][run]") {
    HatRun run;
    run.folder.write("dev/i2c-2", "");
    run.write_robot("hat = i2c { bus = 2, address = 0x60, safe = '\\xFD\\x10' }");
    run.start({"--duration", "1"});
    CHECK(run.program->wait() == 0);
    INFO(run.program->error);
    std::ifstream file(run.folder.path("dev/i2c-2"));
    std::string text;
    std::getline(file, text);
    CHECK(text == "\xFD\x10");
}

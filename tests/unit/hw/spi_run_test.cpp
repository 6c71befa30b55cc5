// Devices on SPI: the transfers that the kernel is asked for.
#include <catch2/catch.hpp>
#include <csignal>
#include <string>

#include "tests/unit/hw/board_run.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// An analogue-digital converter MCP3008: channel 0 has 0x2A5.
std::string converter(const std::string& sent) { return sent == std::string("\1\x80\0", 3) ? "\xFF\xFA\xA5" : sent; }

const std::string adc_driver = R"(
local target = input("target_velocity_in", "TimedVelocity2D")
local velocity = output("current_velocity_out", "TimedVelocity2D")
local adc_in = input("adc_in", "TimedOctetSeq", nil, { queue = 100 })
local motor_out = output("motor_out", "TimedOctetSeq")
function on_execute()
  while adc_in.is_new do
    local high, low = adc_in:read():byte(5, 6)
    if not state.said then log.info(("channel 0 has %X"):format((high & 3) << 8 | low)) end
    state.said = true
  end
  velocity:write(target:read())
  motor_out:write("\x06" .. string.char(math.floor(target:read().vx * 100 + 0.5)))
end
)";

struct SpiRun : BoardRun {
    SpiRun() {
        board->add("spidev0.0");
        board->add("spidev0.1");
        board->set_spi("spidev0.0", converter);
        write_robot(
            "adc = spi { bus = 0, chip_select = 0, speed = 500000, mode = 3, frames = { '\\x01\\x80\\x00' }, every = "
            "0.02, safe = false }, motor = spi { chip_select = 1, safe = '\\x06\\x00' }");
        write_driver(adc_driver);
    }
    bool has(const std::string& transaction) const {
        const auto all = board->transactions();
        return std::find(all.begin(), all.end(), transaction) != all.end();
    }
};

}  // namespace

TEST_CASE(
    "a robot drives by a device on SPI, and reads another every period; its safe bytes come after the engine's end",
    "[hw][wire][run][safety][wallclock]") {
    SpiRun run;
    const bool goes = run.goes([&] { return run.has("spidev0.1 06 14"); });
    INFO(run.program->error);
    REQUIRE(goes);
    CHECK(run.program->wait_for_error("channel 0 has 2A5", 5));
    CHECK(run.has("spidev0.0 mode 3, 8 bits, 500000 Hz"));
    CHECK(run.has("spidev0.0 01 80 00"));
    run.program->send(SIGKILL);
    CHECK(holds_within(0.25, [&] { return run.board->transactions().back() == "spidev0.1 06 00"; }));
}

TEST_CASE("the answers to single messages on SPI are read if they are wanted", "[hw][wire][run][wallclock]") {
    SpiRun run;
    const std::string motor = GENERATE("", ", answers = true");
    run.board->set_spi("spidev0.1", [](const std::string& sent) { return std::string(sent.size(), '\x7A'); });
    run.write_robot("motor = spi { chip_select = 1, safe = '\\x06\\x00'" + motor + " }");
    run.write_driver(R"(
local target = input("target_velocity_in", "TimedVelocity2D")
local motor_in = input("motor_in", "TimedOctetSeq", nil, { queue = 100 })
local motor_out = output("motor_out", "TimedOctetSeq")
function on_execute()
  while motor_in.is_new do
    local answer, age = motor_in:read(), motor_in.age
    if answer:sub(1, 2) == "\x06\x14" and not state.said then
      log.info(("answer %X %X"):format(answer:byte(3, 4)) .. (age < 1 and " in time" or ""))
      state.said = true
    end
  end
  motor_out:write("\x06" .. string.char(math.floor(target:read().vx * 100 + 0.5)))
end
)");
    REQUIRE(run.goes([&] { return run.has("spidev0.1 06 14"); }));
    if (motor.empty()) {
        run.program->listen(0.5);
        CHECK(run.program->error.find("answer") == std::string::npos);
    } else {
        CHECK(run.program->wait_for_error("answer 7A 7A in time", 5));
    }
}

TEST_CASE("a file that is not an SPI device is refused by one line", "[hw][wire][run][wallclock]") {
    SpiRun run;
    std::string device = "safe = '\\x06\\x00'", expected;
    SECTION("without the node") {
        device += ", bus = 2";
        expected =
            "spidev2.0: no such file or directory: is SPI on? On a Raspberry Pi: sudo raspi-config nonint do_spi 0";
    }
    SECTION("a node of another kind") {
        run.board->add("i2c-1");
        device += ", path = '/dev/i2c-1'";
        expected = "i2c-1: it is not an SPI device: expected a device such as /dev/spidev0.0";
    }
    SECTION("without a frame's bytes") {
        device += ", frames = { '' }";
        expected = "robot_model: device 'motor': frames: expected the bytes that are sent, got an empty string";
    }
    run.write_robot("motor = spi { " + device + " }");
    const std::string refusal = run.refusal();
    INFO(refusal);
    CHECK(refusal.find(expected) != std::string::npos);
}

// All writes of a run to the mouse's nodes, byte for byte.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/whole_file.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// Each of these for half a second: long enough for a fixed order of writes.
const std::string behavior = R"(
local vel = output("vel", "TimedVelocity2D")
local leds = output("leds", "TimedBooleanSeq")
local tone = output("tone", "TimedShort")
local steps = {
  { vx = 0, va = 0, tone = 0, lit = false },
  { vx = 0, va = 0, tone = 880, lit = false },
  { vx = 0, va = 0, tone = 880, lit = true },
  { vx = 0, va = 0, tone = 0, lit = true },
  { vx = 0.1, va = 0, tone = 0, lit = true },
  { vx = 0.1, va = 1, tone = 0, lit = true },
  { vx = 0, va = -2, tone = 0, lit = true },
  { vx = -0.05, va = 0, tone = 0, lit = true },
  { vx = 0, va = 0, tone = 0, lit = true },
  { vx = 0, va = 0, tone = 0, lit = false },
}
function on_execute()
  local step = steps[math.min(#steps, 1 + math.floor(now() / 0.5))]
  vel:write { vx = step.vx, va = step.va }
  leds:write { false, step.lit, false, false }
  tone:write(step.tone)
end
)";

// The shipped model without ramps, because the steps of a ramp depend on the times of ticks.
std::string quick_mouse() {
    std::string text = read_whole(mouse_file(), mouse_file()).value_or("");
    const auto replace = [&](const std::string& what, const std::string& with) {
        const auto at = text.find(what);
        REQUIRE(at != std::string::npos);
        text.replace(at, what.size(), with);
    };
    const std::string quick = "acceleration = 1000, yaw_acceleration = 10000";
    replace("acceleration = 2.0, yaw_acceleration = 12", quick);
    replace("acceleration = 0.52, yaw_acceleration = 4", quick);
    replace("\"ir_table.csv\"", "{ { 0.01, 1394 }, { 0.3, 8 } }");
    return text;
}

const std::string system_file = R"(
robot "mouse" { model = "quick_mouse" }
behavior "driver" { script = "steps" }
connect("driver.vel", "mouse.target_velocity_in")
connect("driver.leds", "mouse.led4bit_in")
connect("driver.tone", "mouse.buzzer_hz_in")
)";

// The log without times. At the end the guard stops the power and both motors in any order; here they are sorted by
// name.
std::string writes(const std::string& log) {
    std::vector<std::string> all;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) all.push_back(line.substr(line.find(' ') + 1) + "\n");
    constexpr std::ptrdiff_t stops = 3;
    REQUIRE(std::ssize(all) > stops);
    std::sort(all.end() - stops, all.end());
    return std::accumulate(all.begin(), all.end(), std::string());
}

}  // namespace

TEST_CASE("a run's writes are those of the golden log, byte for byte", "[hw][run][fakes][wallclock]") {
    FakeMouse fake;
    fake.folder.write("behaviors/steps.lua", behavior);
    fake.folder.write("behaviors/quick_mouse.lua", quick_mouse());
    fake.folder.write("system.lua", system_file);
    const Outcome run =
        run_nezumi({"run", "system.lua", "--hw", "--headless", "--duration", "5", "--dev-root", fake.dev()},
                   fake.folder.path("").string());
    INFO(run.error);
    REQUIRE(run.status == 0);
    const std::string file = source_root() + "/tests/golden/mouse_run.writes";
    const std::string written = writes(fake.say("log"));
    if (std::getenv("NEZUMI_RENEW") != nullptr) std::ofstream(file) << written;
    const auto golden = read_whole(file, file);
    REQUIRE(golden);
    CHECK(written == *golden);
}

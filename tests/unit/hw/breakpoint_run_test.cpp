// A breakpoint while the program drives the fake mouse.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <optional>
#include <string>

#include "tests/unit/file_text.hpp"
#include "tests/unit/hw/hardware_run.hpp"
#include "tests/unit/hw/own_sockets.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("a breakpoint on a real robot shows executions while it drives on", "[hw][run][fakes][wallclock]") {
    const OwnSockets own;
    HardwareRun run;
    run.get_going();
    const std::string said = own.folder.path("said").string();
    const std::string command =
        "{ echo 'break_at(\"ahead.lua:6\")'; sleep 4; } | '" + nezumi_program() + "' attach > '" + said + "' 2>&1";
    CHECK(std::system(command.c_str()) == 0);
    CHECK(run.fake.moves());
    const std::string text = text_of_file(said);
    INFO(text);
    CHECK(count(text, "traces ahead.lua:6: out:write { vx = 0.15 }   (unwatch() ends it)\n") == 1);
    CHECK(count(text, "behaviors/ahead.lua:6 ran at ") >= 2);
    CHECK(count(text, "behaviors/ahead.lua:6 ran at ") <= 5);
    CHECK(count(text, "driver.out -> mouse.target_velocity_in: { vx = 0.15") >= 2);
    CHECK(count(text, "paused") == 0);
}

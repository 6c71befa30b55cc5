// `nezumi run --hw --twin` on the fake mouse.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

using namespace nezumi;
using namespace nezumi::hw;

namespace {

// The numbers of a recording's last row by their column.
std::map<std::string, std::string> last_row(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string names, line, last;
    std::getline(file, names);
    while (std::getline(file, line)) last = line;
    std::map<std::string, std::string> row;
    std::istringstream columns(names), values(last);
    for (std::string name, value; std::getline(columns, name, ',') && std::getline(values, value, ',');)
        row[name] = value;
    return row;
}

double error_x(FakeMouse& fake, const std::string& arena) {
    fake.folder.write("behaviors/ahead.lua",
                      "local out = output('out', 'TimedVelocity2D')\n"
                      "function on_execute() out:write { vx = now() < 2.5 and 0.15 or 0 } end\n");
    fake.folder.write("system.lua", arena +
                                        "robot 'mouse' { model = 'raspimouse' }\n"
                                        "behavior 'driver' { script = 'ahead' }\n"
                                        "connect('driver.out', 'mouse.target_velocity_in')\n");
    const Outcome run =
        run_nezumi({"run", "system.lua", "--hw", "--twin", "--headless", "--duration", "3.5", "--dev-root", fake.dev(),
                    "--record", "run.csv", "--ports", "mouse_twin.error,mouse.current_pose_out"},
                   fake.folder.path("").string());
    INFO(run.error);
    CHECK(run.status == 0);
    auto row = last_row(fake.folder.path("run.csv"));
    INFO("x " << row["mouse.current_pose_out.position.x"]);
    REQUIRE(row.contains("mouse_twin.error.position.x"));
    CHECK(std::abs(std::stod(row["mouse_twin.error.heading"])) < 0.1);
    return std::stod(row["mouse_twin.error.position.x"]);
}

}  // namespace

TEST_CASE("a real mouse and its twin drive the same way", "[hw][twin][fakes][wallclock]") {
    FakeMouse fake;
    CHECK(std::abs(error_x(fake, "")) < 0.01);  // without an arena: on an empty floor
    CHECK(fake.truth().position.x > 0.25);
}

TEST_CASE("a wall that only the twin has stops only the twin, and the error shows it", "[hw][twin][fakes][wallclock]") {
    FakeMouse fake;
    const double ahead = error_x(fake, "arena { box { at = { 0.2, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }\n");
    CHECK(fake.truth().position.x > 0.25);
    CHECK(ahead == Approx(fake.truth().position.x - 0.1).margin(0.03));
}

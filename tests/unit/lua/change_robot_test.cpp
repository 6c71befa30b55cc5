// Robots of a system that was read, changed before it is built.
#include "bindings/lua/files/change_robot.hpp"

#include <algorithm>

#include "bindings/lua/files/robot_file.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/lua/system_reader.hpp"

using namespace nezumi;
using system_files::system_of;

namespace {

Project here() { return Project::of(root / "behaviors/systems/s.lua", {root}); }

std::string change(SystemSpec& spec, const std::string& robot, const std::string& changes) {
    const Project project = here();
    const auto value = read_changes(changes, "s.lua", project);
    REQUIRE(value.has_value());
    FieldCheck check("robot", "robot", {"s.lua", 1}, nullptr);
    const auto changed = change_robot(spec, robot, *value, check, project);
    if (!changed) return changed.error().message;
    const auto fits = check.result();
    return fits ? "" : fits.error().message;
}

const RobotSpec& described(const SystemSpec& spec, std::size_t index) {
    return spec.models.at(std::get<RobotEntry>(spec.entries[index]).described_by());
}

}  // namespace

TEST_CASE("a change of one robot does not change the others", "[lua][system_file]") {
    SystemSpec spec = system_of("robot 'a' { model = 'raspimouse' } robot 'b' { model = 'raspimouse' }");
    CHECK(change(spec, "a", "{ noise = 0.1, sensors = { right_front = { noise = 8 } } }").empty());
    CHECK(described(spec, 0).noise == 0.1);
    CHECK(described(spec, 1).noise == 0);
    CHECK(change(spec, "a", "{ friction = 0.5, sensors = { right_front = { range = 0.5 } } }").empty());
    CHECK(described(spec, 0).noise == 0.1);
    CHECK(described(spec, 0).friction == 0.5);
    const auto& sensors = described(spec, 0).sensors;
    const auto front =
        std::find_if(sensors.begin(), sensors.end(), [](const auto& s) { return s.name == "right_front"; });
    REQUIRE(front != sensors.end());
    CHECK(front->noise == 8);
    CHECK(front->range == 0.5);
}

TEST_CASE("a field that a change removed stays removed", "[lua][system_file]") {
    SystemSpec spec = system_of("robot 'a' { model = 'raspimouse', actuators = { leds = { count = 3 } } }");
    CHECK(change(spec, "a", "{ actuators = { leds = false }, ports = { led4bit_in = false } }").empty());
    for (const ActuatorSpec& actuator : described(spec, 0).actuators) CHECK(actuator.name != "leds");
    CHECK(std::get<RobotEntry>(spec.entries[0]).changes ==
          "{ actuators = { leds = false }, ports = { led4bit_in = false } }");
}

TEST_CASE("a wrong change does not change the system", "[lua][system_file]") {
    SystemSpec spec = system_of("robot 'mouse' { model = 'raspimouse', noise = 0.1 }");
    CHECK(change(spec, "moose", "{ noise = 0.2 }") == "there is no robot 'moose' (did you mean 'mouse'?)");
    CHECK(change(spec, "mouse", "{ noise = 5 }") == "robot: field 'noise' expected a number from 0 to 1, got 5");
    CHECK(change(spec, "mouse", "{ nois = 0.2 }") == "robot: unknown field 'nois' (did you mean 'noise'?)");
    CHECK(change(spec, "mouse", "{ base = 'ev3' }") == "robot: unknown field 'base': it is for robot files");
    CHECK(described(spec, 0).noise == 0.1);
}

// A system written as a file, and read back.
#include "bindings/lua/files/system_text.hpp"

#include <catch2/catch.hpp>

#include "bindings/lua/files/system_file.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

SystemSpec read_text(const std::string& text) {
    const std::filesystem::path root = source_root();
    const Project project = Project::of(root / "behaviors/systems/s.lua", {root});
    auto spec = read_system_text(text, "behaviors/systems/s.lua", project);
    INFO(text);
    INFO((spec ? std::string() : describe(spec.error())));
    REQUIRE(spec.has_value());
    return std::move(*spec);
}

}  // namespace

TEST_CASE("a system is written in the style of a person", "[lua][system_text]") {
    const SystemSpec spec = read_text(R"(
        arena { box { at = { 0.8, 0.0, 0.15 }, size = { 0.1, 1.0, 0.3 } } }
        robot "mouse" { model = "raspimouse", pose = { heading = 1.5 } }
        behavior "controller" { script = "robot_controller", config = { speed_x = 0.1, stop_d = 30 } }
        connect("mouse.ir_sensor_out", "controller.in"))");
    CHECK(write_system_text(spec, "Saved\nby hand") == R"(--- Saved by hand

arena {
  box { at = { 0.8, 0.0, 0.15 }, size = { 0.1, 1.0, 0.3 } },
}

robot("mouse", { model = "raspimouse", pose = { x = 0.0, y = 0.0, heading = 1.5 } })
behavior("controller", { script = "robot_controller", config = { speed_x = 0.1, stop_d = 30 } })

connect("mouse.ir_sensor_out", "controller.in")
)");
}

TEST_CASE("a system that was written and read back is the same", "[lua][system_text]") {
    const SystemSpec spec = read_text(R"(
        seed(9007199254740993) rate(50) physics { step = 0.01 }
        arena {
          size = { 4, 3 }, border = { height = 0.3, thickness = 0.05 },
          box { at = { 1 / 3, -2e-5, 1e5 }, size = { 0.1, 0.2, 0.3 }, yaw = 0.5, color = "#00FF7f", mass = 0.2 },
          box { at = { 1, 0 }, size = { 0.1, 0.2, 0.3 }, pitch = 0.1 },
          cylinder { at = { 1, 1 }, radius = 0.1, height = 0.2, mass = 1, color = "red" },
          marker { name = "door", id = 7, size = 0.08, at = { 2, 0, 0.1 }, facing = math.pi },
        }
        robot("m", { model = "raspimouse", pose = { x = 0.1 }, limits = { speed = 2.0, yaw_acceleration = 3 }, backend = "sim", active = false })
        component "eye" { type = "Camera", on = "m", at = { 0.05, 0, 0.08 }, yaw = 0.1, rate = 30, active = false, config = { width = 640 } }
        behavior "c" { script = "robot_controller", rate = 10, active = false, set = "two words",
          config = { a = 1, b = 1.0, c = true, d = 'a "quoted"\n\\text\1', e = { 1, 2 }, f = { 1, 2.5 }, g = { "x" }, h = { true, false }, i = {}, ["end"] = -1e300 },
          sets = { ["two words"] = { a = 2 }, fast = {} } }
        connect("m.ir_sensor_out", "c.in"))");
    const SystemSpec again = read_text(write_system_text(spec, "again"));
    CHECK(write_system_text(again, "again") == write_system_text(spec, "again"));
    CHECK(again.seed == spec.seed);
    CHECK(again.rate == spec.rate);
    CHECK(again.physics_step == spec.physics_step);
    CHECK(again.arena.boxes[0].at == spec.arena.boxes[0].at);
    CHECK(again.arena.markers[0].facing == spec.arena.markers[0].facing);
    CHECK(again.connections == spec.connections);
    const auto& c = std::get<BehaviorEntry>(again.entries[2]);
    const auto& before = std::get<BehaviorEntry>(spec.entries[2]);
    CHECK(c.sets == before.sets);
    CHECK(c.set == before.set);
    for (const auto& [name, value] : before.config) {
        CAPTURE(name);
        CHECK(c.config.at(name) == value);
    }
}

TEST_CASE("painted lines are written and read back", "[lua][system_text]") {
    const SystemSpec spec = read_text(
        "arena { size = { 2, 2 }, line { points = { { 0, 0 }, { 0.5, -0.25 } }, width = 0.03, color = 'red' }, "
        "line { points = { { 1, 1 }, { 0, 1 } } } }");
    const std::string text = write_system_text(spec, "Lines");
    CHECK(text.find("line { points = { { 0.0, 0.0 }, { 0.5, -0.25 } }, width = 0.03, color = \"#d6453d\" }") !=
          std::string::npos);
    CHECK(text.find("line { points = { { 1.0, 1.0 }, { 0.0, 1.0 } } }") != std::string::npos);
    CHECK(write_system_text(read_text(text), "Lines") == text);
}

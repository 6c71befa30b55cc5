// What native components and the shipped robots have by themselves is told on the pages as their sources say it.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bindings/embed/simulation.hpp"
#include "bindings/lua/files/robot_file.hpp"
#include "engine/base/whole_file.hpp"
#include "engine/values/value_text.hpp"
#include "tests/unit/cli/doc_tables.hpp"
#include "tests/unit/file_text.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;

std::string values_of(const ParameterSpec& spec) {
    std::string text(type_text(spec.initial));
    if (!spec.choices.empty()) {
        std::vector<std::string> choices;
        for (const Value& choice : spec.choices) choices.push_back(lua_text(choice));
        text = fmt::format("one of {}", fmt::join(choices, ", "));
    } else if (spec.min && spec.max) {
        text += fmt::format(" from {} to {}", *spec.min, *spec.max);
    }
    return spec.unit.empty() ? text : fmt::format("{} [{}]", text, spec.unit);
}

std::string parameter_table(const Component& component) {
    std::string text = "| parameter | value | default | meaning |\n|---|---|---|---|\n";
    for (const auto& [spec, value, set, from_outside, from_within] : component.parameters().all())
        text +=
            fmt::format("| `{}` | {} | `{}` | {} |\n", spec.name, values_of(spec), lua_text(spec.initial), spec.doc);
    return text;
}

// The types of native components.
std::vector<std::string> all_types() {
    std::vector<std::string> types;
    for (const auto& [type, makers] : simulated_systems({}).components) types.push_back(type);
    return types;
}

// The parameters that a component of this type can't do without.
std::string_view needed_by(std::string_view type) {
    if (type == "I2c") return "address = 1";
    return type == "Gpio" ? "inputs = { 1 }" : "";
}

Expected<std::string> parameters_of(std::string_view type) {
    Scratch folder;
    const fs::path file = folder.write(
        "s.lua", fmt::format("component 'it' {{ type = '{}', config = {{ {} }} }}", type, needed_by(type)));
    const auto simulation = Simulation::load(file, {.installed = {root}, .log = {}});
    if (!simulation) return Unexpected(simulation.error());
    return parameter_table(*simulation->system().find("it"));
}

Expected<RobotSpec> shipped_model(std::string_view model) {
    const fs::path file = root / "engine/robots" / fmt::format("{}.lua", model);
    return read_robot_file(file, Project::of(file, {root}));
}

std::string limits_row(std::string_view title, const Limits& limits) {
    return fmt::format("| {} | {} | {} | {} | {} |\n", title, limits.speed, limits.yaw_rate, limits.acceleration,
                       limits.yaw_acceleration);
}

const std::string limits_header =
    "| | speed [m/s] | yaw rate [rad/s] | acceleration [m/s²] | yaw acceleration [rad/s²] |\n|---|---|---|---|---|\n";

Expected<std::string> limits_of(std::string_view model) {
    const auto robot = shipped_model(model);
    if (!robot) return Unexpected(robot.error());
    return limits_header + limits_row("in simulation", robot->drive.limits) +
           limits_row("the real robot, until it is calibrated", robot->drive.hardware_limits);
}

// Of all robots that have a driver.
Expected<std::string> hardware_limits(std::string_view) {
    std::string rows;
    std::vector<std::string> models;
    for (const auto& entry : fs::directory_iterator(root / "engine/robots")) {
        if (entry.path().extension() == ".lua") models.push_back(entry.path().stem().string());
    }
    std::sort(models.begin(), models.end());
    for (const std::string& model : models) {
        const auto robot = shipped_model(model);
        if (!robot) return Unexpected(robot.error());
        if (!robot->hardware.driver.empty()) rows += limits_row("`" + model + "`", robot->drive.hardware_limits);
    }
    return limits_header + rows;
}

// "raspimouse.right_front": its value at each distance of the table that the robot file names.
Expected<std::string> ranges_of(std::string_view name) {
    const auto robot = shipped_model(name.substr(0, name.find('.')));
    if (!robot) return Unexpected(robot.error());
    const std::string_view wanted = name.substr(name.find('.') + 1);
    const auto sensor = std::find_if(robot->sensors.begin(), robot->sensors.end(),
                                     [&](const SensorSpec& each) { return each.name == wanted; });
    if (sensor == robot->sensors.end()) return failure(fmt::format("there is no sensor '{}'", wanted));
    std::string distances = "| distance [m] |", line = "|---|", values = "| value |";
    for (const std::string& row : lines_of(text_of_file(root / "engine/robots/ir_table.csv"))) {
        const std::string distance = row.substr(0, row.find(','));
        if (distance.find_first_not_of("0123456789.") != std::string::npos) continue;
        distances += fmt::format(" {} |", distance);
        line += "---|";
        values += fmt::format(" {} |", sensor->response(std::atof(distance.c_str())));
    }
    return fmt::format("{}\n{}\n{}\n", distances, line, values);
}

}  // namespace

TEST_CASE("the pages tell parameters, limits and values of native components and robots as they are", "[cli][fields]") {
    std::string all;
    for (const auto& entry : fs::directory_iterator(root / "docs")) {
        if (entry.path().extension() != ".md") continue;
        const auto page = read_whole(entry.path(), entry.path().string());
        REQUIRE(page.has_value());
        auto fresh = with_tables(*page, "parameters", parameters_of);
        if (fresh) fresh = with_tables(*fresh, "limits", limits_of);
        if (fresh) fresh = with_tables(*fresh, "hardware_limits", hardware_limits);
        if (fresh) fresh = with_tables(*fresh, "ranges", ranges_of);
        INFO((fresh ? "run this test with NEZUMI_RENEW=1 in the environment to bring the page up to date"
                    : describe(fresh.error())));
        REQUIRE(fresh.has_value());
        if (std::getenv("NEZUMI_RENEW") != nullptr) std::ofstream(entry.path(), std::ios::binary) << *fresh;
        CHECK(*fresh == *page);
        all += *page;
    }
    for (const std::string& type : all_types()) {
        CAPTURE(type);
        CHECK(all.find("<!-- parameters: " + type + " -->") != std::string::npos);
    }
    for (const char* table : {"limits: raspimouse", "hardware_limits: robots", "ranges: raspimouse.right_front"}) {
        CAPTURE(table);
        CHECK(all.find(fmt::format("<!-- {} -->", table)) != std::string::npos);
    }
}

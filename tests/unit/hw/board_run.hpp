// `nezumi run --hw` on a robot whose driver is a behaviour, with devices on a fake board.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/fakes/fake_board.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/holds_within.hpp"
#include "tests/unit/lua/scratch_folder.hpp"

namespace nezumi::hw {

struct BoardRun {
    Scratch folder;
    std::optional<FakeBoard> board;
    std::optional<Program> program;

    BoardRun() {
        folder.write("behaviors/ahead.lua",
                     "local target = output('target', 'TimedVelocity2D')\n"
                     "function on_execute() target:write { vx = 0.2 } end\n");
        folder.write("system.lua",
                     "robot 'rover' { model = 'rover' }\n"
                     "behavior 'ahead' { script = 'ahead' }\n"
                     "connect('ahead.target', 'rover.target_velocity_in')\n");
        board.emplace(folder.path("dev").string(), folder.path("sys").string());
    }
    /// The robot's file, with these devices.
    void write_robot(const std::string& devices) {
        folder.write("behaviors/rover.lua",
                     "return robot_model { mass = 1, drive = { radius = 0.03, track = 0.1 },\n"
                     "  sensors = { front = { kind = 'range', at = { 0, 0, 0.02 } } },\n"
                     "  ports = { distance = { type = 'TimedDouble', from = 'front' } },\n"
                     "  hardware = { script = 'rover_driver', devices = { " +
                         devices + " } } }\n");
    }
    void write_driver(const std::string& text) { folder.write("behaviors/rover_driver.lua", text); }

    std::vector<std::string> words() const {
        const std::string dev = folder.path("dev").string();
        return {"run",        "system.lua", "--hw",       "--headless",
                "--dev-root", dev,          "--sys-root", folder.path("sys").string()};
    }
    void start(const std::vector<std::string>& more = {}) {
        std::vector<std::string> all = words();
        all.insert(all.end(), more.begin(), more.end());
        const FakeBoard::Environment environment(folder.path("dev").string());
        program.emplace(all, folder.path("").string());
    }
    bool goes(const std::function<bool()>& drives) {
        start();
        if (holds_within(20, drives)) return true;
        program->listen(0.2);
        return false;
    }
    /// The one line of a run that is refused.
    std::string refusal() {
        start();
        if (program->wait() != 2) return "it was not refused: " + program->error;
        return std::count(program->error.begin(), program->error.end(), '\n') == 1 ? program->error
                                                                                   : "many lines: " + program->error;
    }
};

}  // namespace nezumi::hw

// `nezumi run --hw` on a rover whose driver is a behaviour: its microcontroller is a pseudo-terminal.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hw/guard/lease.hpp"
#include "tests/fakes/fake_rover.hpp"
#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/holds_within.hpp"
#include "tests/unit/lua/scratch_folder.hpp"
#include "tests/unit/source_root.hpp"

namespace nezumi::hw {

// Drives ahead at 0.2 m/s.
inline const std::string rover_ahead = R"(
local target = output("target", "TimedVelocity2D")
function on_execute() target:write { vx = 0.2 } end
)";

inline const std::string rover_system = R"(
robot 'rover' { model = 'rover' }
behavior 'ahead' { script = 'ahead' }
connect('ahead.target', 'rover.target_velocity_in')
)";

struct RoverRun {
    Scratch folder;
    std::optional<FakeRover> rover;
    std::optional<Program> program;

    RoverRun() {
        folder.write("behaviors/ahead.lua", rover_ahead);
        folder.write("system.lua", rover_system);
        std::filesystem::create_directories(folder.path("dev"));
        rover.emplace(node());
    }
    std::string node() const { return folder.path("dev/ttyACM0").string(); }
    void copy(const std::string& from, const std::string& to) const {
        std::filesystem::copy_file(source_root() + "/" + from, folder.path(to));
    }
    void start(const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"run",        "system.lua", "--hw",
                                       "--headless", "--dev-root", folder.path("dev").string()};
        words.insert(words.end(), more.begin(), more.end());
        program.emplace(words, folder.path("").string());
    }
    void get_going() {
        // The terminal may have the number of an earlier one, whose writer is about to end.
        const std::string terminal = std::filesystem::canonical(node()).string();
        REQUIRE(holds_within(10, [&] { return Lease::take("wire " + terminal, terminal).has_value(); }));
        start();
        const bool goes = holds_within(20, [&] { return rover->speed() > 0.19; });
        if (!goes) program->listen(0.2);
        INFO(program->error);
        REQUIRE(goes);
    }
    bool stands_within(double seconds) const {
        return holds_within(seconds, [&] { return rover->speed() == 0; });
    }
};

}  // namespace nezumi::hw

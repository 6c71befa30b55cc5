// `nezumi run --hw` on the fake mouse.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/cli/run_program.hpp"
#include "tests/unit/hw/fake_mouse_rig.hpp"

namespace nezumi::hw {

/// Drives ahead. The third button starts an endless loop, and at 2 s of the engine's clock it may fail.
inline const std::string behavior_ahead = R"(
local buttons = input("buttons", "TimedBooleanSeq")
local out = output("out", "TimedVelocity2D", "velocity")
param("fails_at_2_s", false)
function on_execute()
  out:write { vx = 0.15 }
  if buttons:read()[3] then while true do end end
  if config.fails_at_2_s and now() > 2 then error("no luck") end
end
)";

/// The program drives the fake mouse, from standstill to a steady 0.15 m/s.
struct HardwareRun {
    explicit HardwareRun(const std::string& config = "", const std::string& model = "raspimouse",
                         const std::vector<std::string>& more = {}) {
        fake.folder.write("behaviors/ahead.lua", behavior_ahead);
        fake.folder.write("behaviors/waiting_mouse.lua", shipped_model(", start = \"switch0\""));
        fake.folder.write("behaviors/shutdown_mouse.lua", shipped_model(", shutdown = \"switch1\""));
        fake.folder.write("system.lua", "robot 'mouse' { model = '" + model +
                                            "' }\n"
                                            "behavior 'driver' { script = 'ahead', config = { " +
                                            config +
                                            " } }\n"
                                            "connect('mouse.switch3bit_out', 'driver.buttons')\n"
                                            "connect('driver.out', 'mouse.target_velocity_in')\n");
        std::filesystem::create_directory_symlink(fake.dev(), dev());
        std::vector<std::string> words{"run", "system.lua", "--hw", "--headless", "--dev-root", dev()};
        words.insert(words.end(), more.begin(), more.end());
        program.emplace(words, fake.folder.path("").string());
    }
    // A program with a thread that hangs in the kernel does not end.
    ~HardwareRun() {
        fake.say("heal");
        program.reset();
    }
    HardwareRun(const HardwareRun&) = delete;
    HardwareRun& operator=(const HardwareRun&) = delete;
    // The shipped model, with more about its hardware.
    static std::string shipped_model(const std::string& more) {
        std::ifstream file(mouse_file());
        std::string text((std::istreambuf_iterator<char>(file)), {});
        const std::string plain = "driver = \"raspimouse\"";
        text.replace(text.find(plain), plain.size(), plain + more);
        const std::string table = "\"ir_table.csv\"";
        text.replace(text.find(table), table.size(), "{ { 0.01, 1394 }, { 0.3, 8 } }");
        return text;
    }
    void get_going() {
        INFO(program->error);
        REQUIRE(FakeMouse::wait_until([&] { return fake.motion().left > 390; }, 20));
        sleep_for(0.1);
    }
    // The time [s] from `cause` until the wheels stand.
    double time_to_stand(const std::function<void()>& cause) {
        const double begin = clock_seconds();
        cause();
        REQUIRE(FakeMouse::wait_until([&] { return !fake.moves(); }, 3));
        return fake.motion().still_since - begin;
    }
    pid_t guard() const {
        std::ifstream children("/proc/" + std::to_string(program->process()) + "/task/" +
                               std::to_string(program->process()) + "/children");
        pid_t child = 0;
        children >> child;
        return child;
    }

    // A path to the fake's nodes that can be redirected.
    std::string dev() const { return fake.folder.path("dev").string(); }

    FakeMouse fake;
    std::optional<Program> program;
};

}  // namespace nezumi::hw

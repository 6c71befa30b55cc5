// Fifty mice with laser scanners of 90 rays at 10 Hz in one arena, compared with real time.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "bindings/lua/reload/lua_host.hpp"
#include "engine/live/running_system.hpp"
#include "tests/bench/whole_engine.hpp"

using namespace nezumi;

namespace {

constexpr const char* robot_text = R"(
return robot_model {
  base = "raspimouse",
  sensors = { laser = { kind = "scan", at = { 0, 0, 0.03 }, range = 4, rays = 90 } },
  ports = { scan = { type = "RangeData", from = "laser", rate = 10 } },
}
)";

constexpr const char* driver_text = R"(
local scan = input("scan", "RangeData", "distances around the mouse")
local out = output("out", "TimedVelocity2D", "velocity")
function on_execute()
  local near = math.huge
  for _, distance in ipairs(scan:read().ranges) do near = math.min(near, distance) end
  out:write { vx = near > 0.3 and 0.2 or 0, va = near > 0.3 and 0 or 1 }
end
)";

constexpr const char* system_text = R"(
rate(10)
arena { size = { 8, 8 } }
for i = 0, 49 do
  robot("mouse_" .. i, { model = "scanner", pose = { x = i % 7 - 3, y = i // 7 - 3.5, heading = i % 6 } })
  behavior("driver_" .. i, { script = "driver" })
  connect("mouse_" .. i .. ".scan", "driver_" .. i .. ".scan")
  connect("driver_" .. i .. ".out", "mouse_" .. i .. ".target_velocity_in")
end
)";

}  // namespace

int main() {
    constexpr int ticks = 200;
    constexpr double period = 0.1;  // [s]
    bench::print_header("laser scanners", "50 mice, 90 rays of 4 m at 10 Hz, tick 10 Hz, physics 5 ms, one thread");
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("nezumi_scan_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder / "behaviors");
    std::ofstream(folder / "behaviors" / "scanner.lua") << robot_text;
    std::ofstream(folder / "behaviors" / "driver.lua") << driver_text;
    std::ofstream(folder / "fifty.lua") << system_text;
    LiveOptions options;
    options.scripts = &lua_scripts();
    options.installed = {NEZUMI_SOURCE_ROOT};
    options.world = sim::make_world;
    options.budget = headless_budget;
    const auto live = bench::must(RunningSystem::load(folder / "fifty.lua", std::move(options)));
    live->activate();
    double best = 0;
    for (int round = 0; round < 5; ++round) {
        const double seconds = bench::time_of([&] {
            for (int i = 0; i < ticks; ++i) live->tick();
        });
        best = std::max(best, ticks * period / seconds);
    }
    std::printf("%.1f times real time, the best of 5 rounds of 20 s (aim 60: %s)\n", best,
                best >= 60 ? "ok" : "MISSED");
    std::filesystem::remove_all(folder);
}

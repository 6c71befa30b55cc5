// Going back in time: what a seek costs beside the run that it computes again, and what a running system keeps for it.
//
// Limits: ten minutes of one mouse in 0.5 s, on a core that simulates it 2000 times as fast as real time; a seek takes
// no longer than its ticks took; the history adds at most 1 % to a tick. CPU time, but for the column of wall-clock
// time. With robots and minutes as arguments: only that run. With `--keeping`: only what the history costs.
#include <malloc.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/lua/reload/lua_host.hpp"
#include "engine/live/past_run.hpp"
#include "engine/live/running_system.hpp"
#include "engine/trace/trace.hpp"
#include "engine/trace/trace_hash.hpp"
#include "tests/bench/whole_engine.hpp"

using namespace nezumi;

namespace {

constexpr std::int64_t ticks_a_minute = 6000;  // at 100 Hz

// Mice that follow walls, each in a room of its own.
std::string system_text(std::size_t mice) {
    return R"(
local count = )" +
           std::to_string(mice) + R"(
local across = math.ceil(math.sqrt(count))
for i = 1, count do
  local x, y = 2 * ((i - 1) % across), 2 * ((i - 1) // across)
  arena { box { at = { x + 0.8, y, 0.05 }, size = { 0.1, 1.6, 0.1 } }, box { at = { x - 0.8, y, 0.05 }, size = { 0.1, 1.6, 0.1 } },
          box { at = { x, y + 0.8, 0.05 }, size = { 1.6, 0.1, 0.1 } }, box { at = { x, y - 0.8, 0.05 }, size = { 1.6, 0.1, 0.1 } } }
  robot("mouse_" .. i, { model = "raspimouse", pose = { x = x, y = y + 0.6, heading = 0 } })
  behavior("follower_" .. i, { script = "wall_follower" })
  connect("mouse_" .. i .. ".ir_sensor_metre_out", "follower_" .. i .. ".ranges")
  connect("follower_" .. i .. ".target", "mouse_" .. i .. ".target_velocity_in")
end
)";
}

std::unique_ptr<RunningSystem> load(const std::filesystem::path& file) {
    LiveOptions options;
    options.scripts = &lua_scripts();
    options.installed = {NEZUMI_SOURCE_ROOT};
    options.world = sim::make_world;
    options.budget = headless_budget;
    auto live = bench::must(RunningSystem::load(file, std::move(options)));
    live->trace().remember_ports();
    live->activate();
    return live;
}

double used_kilobytes() { return static_cast<double>(mallinfo2().uordblks) / 1024; }

void measure(const std::filesystem::path& folder, std::size_t mice, std::int64_t minutes) {
    const std::filesystem::path file = folder / ("mice_" + std::to_string(mice) + ".lua");
    std::ofstream(file) << system_text(mice);
    const std::unique_ptr<RunningSystem> live = load(file);
    const std::int64_t ticks = minutes * ticks_a_minute;
    double after_first_minute = 0;
    const double run = bench::time_of([&] {
        for (std::int64_t tick = 0; tick < ticks; ++tick) {
            live->tick();
            if (tick == ticks_a_minute) after_first_minute = used_kilobytes();  // plots remember no more after it
        }
    });
    const double kept = used_kilobytes() - after_first_minute;
    const std::uint64_t hash = live->trace_hash();
    const auto begin = std::chrono::steady_clock::now();
    const double seek = bench::time_of([&] {
        bench::must(live->act(Seek{.tick = ticks - 1}, {Actor::Kind::console, ""}));
    });
    const double waited = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    live->tick();
    std::printf("%8zu %8lld %9.2f %9.2f %9.2f %8.2f %10.1f  %s\n", mice, static_cast<long long>(minutes), run, seek,
                waited, seek / run, minutes > 1 ? kept / static_cast<double>(minutes - 1) : 0.0,
                live->trace_hash() == hash ? "same" : "DIFFERS");
    std::fflush(stdout);
}

// A tick of a running system, which keeps the history that a seek needs, against one of the engine alone with the same
// hash and remembered ports, in turns.
void measure_keeping(const std::filesystem::path& folder, const char* name, const std::string& text, int ticks) {
    const std::filesystem::path file = folder / (std::string(name) + ".lua");
    std::ofstream(file) << text;
    bench::WholeEngine engine(text);
    Trace trace;
    TraceHash hash;
    trace.start(*engine.system);
    trace.remember_ports();
    engine.system->observe(hash);
    const std::unique_ptr<RunningSystem> live = load(file), remembering = load(file);
    remembering->remember_run();
    std::vector<double> history, line;
    for (int round = 0; round < 31; ++round) {
        const auto run = [ticks](RunningSystem& each) {
            return bench::time_of([&] {
                for (int i = 0; i < ticks; ++i) each.tick();
            });
        };
        const double alone = bench::time_of([&] { engine.run(ticks); });
        const double kept = run(*live), remembered = run(*remembering);
        history.push_back(kept / alone);
        line.push_back(remembered / kept);
    }
    std::printf("  %-8s %26.3f (limit 1.01: %s) %26.3f\n", name, bench::median(history),
                bench::verdict(bench::median(history), 1.01), bench::median(line));
    std::fflush(stdout);
}

// As bench_swarm has it.
constexpr const char* swarm_text = "require 'lib.swarm_arena' { count = 100, side = 10, model = 'swarm_robot' }";

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("nezumi_seek_" + std::to_string(std::rand()));
    std::filesystem::create_directories(folder);
    bench::print_header("going back in time", "mice that follow walls at 100 Hz, physics 5 ms, all ports remembered");
    const bool keeping_alone = argc == 2 && std::string_view(argv[1]) == "--keeping";
    if (!keeping_alone) std::puts("  robots  minutes   run [s]  seek [s]  wall [s] seek/run  KB/minute  hash");
    if (argc == 3) {
        measure(folder, std::strtoul(argv[1], nullptr, 10), std::strtol(argv[2], nullptr, 10));
    } else if (!keeping_alone) {
        for (const std::size_t mice : {1, 10, 100}) {
            for (const std::int64_t minutes : {1, 10}) measure(folder, mice, minutes);
        }
        measure(folder, 1, 60);
    }
    if (argc < 3) {
        std::puts(
            "\n  a tick with the history / without, and with the time line's places and marks / with the history "
            "alone");
        measure_keeping(folder, "mouse", bench::mouse_text, 5000);
        measure_keeping(folder, "swarm", swarm_text, 100);
    }
    std::filesystem::remove_all(folder);
}

// How long a save takes to act: from the end of the save to the first tick of the new code, at a tick of 100 Hz.
//
// Limit: a median under 20 ms. Half a tick of it is waiting for the next one.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bindings/lua/reload/lua_host.hpp"
#include "engine/live/running_system.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// 200 lines that end in writing `value`.
std::string script(int value) {
    std::string text = "local out = output('out', 'TimedLong')\n";
    for (int i = 0; i < 195; ++i)
        text += "local function f" + std::to_string(i) + "(x) return x * " + std::to_string(i) + " + 1 end\n";
    return text + "function on_execute()\n  out:write(" + std::to_string(value) + ")\nend\n";
}

}  // namespace

int main() {
    bench::print_header("from a save to the first tick of the new code",
                        "100 saves of 200 lines by renaming, tick 100 Hz");
    const fs::path folder = fs::temp_directory_path() / ("nezumi_bench_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const std::string file = (folder / "it.lua").string();
    std::ofstream(file) << script(0);

    const fs::path system_file = folder / "system.lua";
    std::ofstream(system_file) << "behavior 'it' { script = 'it' }\n";
    LiveOptions options;
    options.scripts = &lua_scripts();
    options.watch = true;
    auto live = RunningSystem::load(system_file, std::move(options)).value();
    live->activate();
    const auto& out = *live->system().find("it")->find_out_port("out");

    std::mt19937 random(1);
    std::vector<double> latencies;
    double longest = 0;
    auto next = Clock::now();
    auto saved = Clock::now();
    int value = 0;
    int wait = 30;
    while (latencies.size() < 100) {
        std::this_thread::sleep_until(next);
        const auto begin = Clock::now();
        live->tick();
        const auto end = Clock::now();
        longest = std::max(longest, std::chrono::duration<double, std::milli>(end - begin).count());
        next += std::chrono::milliseconds(10);
        if (--wait == 0) {
            // At any moment between two ticks; the save itself is what an editor does.
            std::this_thread::sleep_for(std::chrono::microseconds(random() % 8000));
            std::ofstream(file + ".new") << script(++value);
            fs::rename(file + ".new", file);
            saved = Clock::now();
        } else if (wait < 0 && out.value().get<std::int32_t>() == value) {
            latencies.push_back(std::chrono::duration<double, std::milli>(begin - saved).count());
            wait = 5 + static_cast<int>(random() % 10);
        }
    }
    live.reset();
    fs::remove_all(folder);
    std::sort(latencies.begin(), latencies.end());
    std::printf("median %.1f ms (limit 20: %s), 90 %% %.1f ms, longest %.1f ms; longest tick %.2f ms\n", latencies[50],
                bench::verdict(latencies[50], 20), latencies[90], latencies.back(), longest);
}

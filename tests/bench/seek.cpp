// Going back in time: what a seek costs beside the run that it computes again, and what a running system keeps for it.
//
// Limits: ten minutes of one mouse in 0.5 s, on a core that simulates it 2000 times as fast as real time; a seek takes
// no longer than its ticks took; the history adds at most 1 % to a tick. CPU time, but for the column of wall-clock
// time. With robots and minutes as arguments: only that run. With `--keeping`: only what the history costs. With
// `--many`, a number of seeks and minutes: random moments of a run with changes and branches, each compared with the
// hash that was seen there first.
#include <malloc.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
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

// The hashes that were seen first, by branch and tick.
class SeenHashes {
public:
    void note(const RunningSystem& live) {
        const std::size_t branch = live.history().current();
        if (branch >= seen_.size()) seen_.resize(branch + 1);
        const std::int64_t tick = live.when().tick;
        if (seen_[branch].empty()) first_.resize(branch + 1, tick);
        const auto index = static_cast<std::size_t>(tick - first_[branch]);
        if (index == seen_[branch].size()) seen_[branch].push_back(live.trace_hash());
    }
    bool is_same(const RunningSystem& live) const {
        const auto& branches = live.history().branches();
        const std::int64_t tick = live.when().tick;
        std::size_t branch = live.history().current();
        while (branch > 0 && tick <= branches[branch].left.tick) branch = branches[branch].parent;
        return seen_[branch].at(static_cast<std::size_t>(tick - first_[branch])) == live.trace_hash();
    }

private:
    std::vector<std::vector<std::uint64_t>> seen_;
    std::vector<std::int64_t> first_;  // ticks
};

// A person's changes, of three kinds.
void change(RunningSystem& live, std::mt19937& random) {
    const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const Actor who{Actor::Kind::console, ""};
    switch (random() % 8) {
        case 0:
            bench::must(live.act(Teleport{"mouse_1", {{draw(-0.5, 0.5), draw(-0.5, 0.5)}, draw(-3, 3)}}, who));
            return;
        case 1: {
            std::ifstream file(NEZUMI_SOURCE_ROOT "/behaviors/wall_follower.lua");
            std::string text{std::istreambuf_iterator<char>(file), {}};
            text += "-- " + std::to_string(random()) + "\n";
            bench::must(live.act(Reload{.component = "follower_1", .shown = "wall_follower.lua", .text = text}, who));
            return;
        }
        default: bench::must(live.act(SetParameter{"follower_1", "speed", Value(draw(0.05, 0.3))}, who));
    }
}

// Every hundredth seek is followed by a change, and so by a branch.
int measure_many(const std::filesystem::path& folder, int seeks, std::int64_t minutes) {
    const std::filesystem::path file = folder / "mice_1.lua";
    std::ofstream(file) << system_text(1);
    const std::unique_ptr<RunningSystem> live = load(file);
    std::mt19937 random(124);
    SeenHashes hashes;
    const auto run = [&](std::int64_t ticks) {
        for (; ticks > 0; --ticks) {
            live->tick();
            hashes.note(*live);
        }
    };
    hashes.note(*live);
    for (std::int64_t tick = 0; tick < minutes * ticks_a_minute; tick += 1000) {
        run(1000);
        change(*live, random);
    }
    run(1000);
    int different = 0;
    double longest = 0;
    const auto compare = [&] { different += hashes.is_same(*live) ? 0 : 1; };
    const double spent = bench::time_of([&] {
        for (int seek = 1; seek <= seeks; ++seek) {
            const auto& branches = live->history_until_now().branches();
            const RunHistory::Branch& branch = branches[random() % branches.size()];
            const auto tick = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(branch.end.tick + 1));
            const Seek where{.branch = branch.name, .tick = tick};
            longest = std::max(longest, bench::time_of([&] {
                                   bench::must(live->act(where, {Actor::Kind::console, ""}));
                               }));
            compare();
            if (seek % 10 == 0 && live->is_past()) {
                live->tick();
                compare();
            }
            if (seek % 100 == 0 && live->is_past()) {
                change(*live, random);
                run(1 + static_cast<std::int64_t>(random() % 3000));
            }
            if (seek % 1000 == 0) {
                std::printf("  %6d seeks, %d different\n", seek, different);
                std::fflush(stdout);
            }
        }
    });
    std::printf(
        "  %d seeks in a run of %lld minutes with %zu branches: %d different, %.2f s each, %.2f s the longest\n", seeks,
        static_cast<long long>(minutes), live->history().branches().size(), different, spent / seeks, longest);
    return different == 0 ? 0 : 1;
}

// As bench_swarm has it.
constexpr const char* swarm_text = "require 'lib.swarm_arena' { count = 100, side = 10, model = 'swarm_robot' }";

}  // namespace

int main(int argc, char** argv) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("nezumi_seek_" + std::to_string(std::rand()));
    std::filesystem::create_directories(folder);
    bench::print_header("going back in time", "mice that follow walls at 100 Hz, physics 5 ms, all ports remembered");
    if (argc == 4 && std::string_view(argv[1]) == "--many") {
        const int status = measure_many(folder, std::atoi(argv[2]), std::strtol(argv[3], nullptr, 10));
        std::filesystem::remove_all(folder);
        return status;
    }
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

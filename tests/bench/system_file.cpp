// How long it takes to read a system file: the tutorial's, and swarms of 10 to 10 000 robots.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "bindings/lua/files/system_file.hpp"
#include "engine/base/whole_file.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

const std::filesystem::path root = NEZUMI_SOURCE_ROOT;

void read(benchmark::State& state, const std::string& text) {
    const std::string file = (root / "behaviors/systems/any.lua").string();
    const Project project = Project::of(file, {root});
    for (auto run : state) {
        const auto spec = read_system_text(text, file, project, {.seconds = 60});
        if (!spec) state.SkipWithError(describe(spec.error()).c_str());
        benchmark::DoNotOptimize(spec);
    }
}

void tutorial(benchmark::State& state) {
    read(state, *read_whole(root / "behaviors/systems/stop_at_wall.lua", "stop_at_wall.lua"));
}
BENCHMARK(tutorial)->Unit(benchmark::kMillisecond);

void swarm(benchmark::State& state) {
    const auto count = state.range(0);
    const int side = count <= 10 ? 4 : count <= 100 ? 10 : count <= 1000 ? 32 : 100;
    read(state,
         fmt::format("require 'lib.swarm_arena' {{ count = {}, side = {}, model = 'swarm_robot' }}", count, side));
}
BENCHMARK(swarm)->Unit(benchmark::kMillisecond)->RangeMultiplier(10)->Range(10, 10000);

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    nezumi::bench::print_header("reading system files", "the tutorial and swarms of 10 to 10000 robots, 60 s budget");
    benchmark::RunSpecifiedBenchmarks();
}

// The swarm workload with the whole engine and Lua, against a bare ODE loop of the same bodies, contacts and steps
// without rays and Lua.
//
// N robots with 24 rays each; control at 10 Hz in behaviors/swarm.lua, 10 steps of 10 ms a tick, seed 124. Limits: at
// most `aim_of` times the bare loop; the cost of a robot at 1000 at most 1.3 times that at 10; start-up linear in N and
// under 0.5 s at 1000; threads never slower than none, with the same trace hash. With sizes as arguments: only those.
// With `--profile N`: the engine alone, for perf.
#include <chrono>

#include "engine/trace/trace.hpp"
#include "tests/bench/bare_ode.hpp"
#include "tests/bench/whole_engine.hpp"

using namespace nezumi;

namespace {

// The body of engine/robots/swarm_robot.lua.
constexpr bench::BareRobotSpec disc{1.6, 0.029, 0.14, 0.0, 0.07, true, 0.17, 0.17, 0.12};

// `more`: further options of the arena.
std::string system_text(std::size_t count, const std::string& more = "") {
    return "require 'lib.swarm_arena' { count = " + std::to_string(count) +
           ", side = " + std::to_string(static_cast<int>(bench::swarm_side(count))) + ", model = 'swarm_robot'" + more +
           " }";
}

// The same robots at the same places, turning on the spot so that they don't leave.
class Bare {
public:
    explicit Bare(const SystemSpec& spec) : loop_(with_skid(spec), spec.physics_step) {
        std::size_t count = 0;
        for (const Entry& entry : spec.entries) {
            const auto* robot = std::get_if<RobotEntry>(&entry);
            if (robot == nullptr) continue;
            loop_.add(robot->pose.position.x, robot->pose.position.y, robot->pose.heading);
            loop_.drive(count++, -0.05, 0.05);
        }
    }

    void run(int ticks) {
        for (int i = 0; i < ticks * 10; ++i) loop_.step();
    }

private:
    static bench::BareRobotSpec with_skid(const SystemSpec& spec) {
        bench::BareRobotSpec bare = disc;
        bare.skid = spec.models.begin()->second.drive.skid;
        return bare;
    }

    bench::BareLoop loop_;
};

struct Row {
    std::size_t count = 0;
    double start = 0;  // [s]
    double bare = 0;   // [us] a robot-tick
    double engine = 0;
    double ratio = 0;
};

// What the engine may cost at most, in bare loops.
double aim_of(std::size_t count) {
    if (count < 10) return 0.40;
    if (count < 1000) return 0.35;
    return count < 10'000 ? 0.55 : 0.50;
}

Row measure(std::size_t count) {
    const int ticks = static_cast<int>(std::max<std::size_t>(2, 4'000 / count));
    const int rounds = count >= 10'000 ? 5 : 15;
    bench::WholeEngine engine(system_text(count));
    Bare bare(engine.spec);
    engine.run(std::min(ticks, 50));
    bare.run(std::min(ticks, 50));
    std::vector<double> bare_us, engine_us, ratios;
    for (int round = 0; round < rounds; ++round) {
        const double a = bench::time_of([&] { bare.run(ticks); });
        const double b = bench::time_of([&] { engine.run(ticks); });
        const double robot_ticks = static_cast<double>(count) * ticks;
        bare_us.push_back(a / robot_ticks * 1e6);
        engine_us.push_back(b / robot_ticks * 1e6);
        ratios.push_back(b / a);
    }
    const Row row{count, engine.read_seconds + engine.build_seconds, bench::median(bare_us), bench::median(engine_us),
                  bench::median(ratios)};
    std::printf("%8zu %10.0f %10.0f %9.2f %7s %10.4f + %.4f\n", count, 1e6 / row.bare, 1e6 / row.engine, row.ratio,
                bench::verdict(row.ratio, aim_of(row.count)), engine.read_seconds, engine.build_seconds);
    std::fflush(stdout);
    return row;
}

// Of the tick's wall-clock time: threads against none, in turns.
void compare_threads(std::size_t count) {
    const int ticks = static_cast<int>(std::max<std::size_t>(2, 2'000 / count));
    bench::WholeEngine one(system_text(count)), two(system_text(count), 2);
    TraceHash hash_of_one, hash_of_two;
    one.system->observe(hash_of_one);
    two.system->observe(hash_of_two);
    one.run(20);
    two.run(20);
    const bool same = hash_of_one.value() == hash_of_two.value();
    one.system->stop_observing(hash_of_one);
    two.system->stop_observing(hash_of_two);
    std::vector<double> ratios;
    for (int round = 0; round < 15; ++round) {
        const auto begin = std::chrono::steady_clock::now();
        one.run(ticks);
        const auto middle = std::chrono::steady_clock::now();
        two.run(ticks);
        const auto end = std::chrono::steady_clock::now();
        ratios.push_back(std::chrono::duration<double>(end - middle) / std::chrono::duration<double>(middle - begin));
    }
    std::printf("%8zu %10.2f %10s\n", count, bench::median(ratios), same ? "same" : "DIFFERS");
    std::fflush(stdout);
}

// CPU time with ports remembered, against without, in turns. In a large system they are followed only when asked for.
void compare_trace(std::size_t count) {
    const int ticks = static_cast<int>(std::max<std::size_t>(2, 4'000 / count));
    Trace trace;
    bench::WholeEngine plain(system_text(count)), traced(system_text(count));
    trace.start(*traced.system);
    trace.remember_ports();
    plain.run(20);
    traced.run(20);
    std::vector<double> ratios;
    for (int round = 0; round < 15; ++round) {
        const double a = bench::time_of([&] { plain.run(ticks); });
        const double b = bench::time_of([&] { traced.run(ticks); });
        ratios.push_back(b / a);
    }
    std::printf("%8zu %10.3f\n", count, bench::median(ratios));
    std::fflush(stdout);
}

// CPU time of a tick in which each robot looks for its neighbours within `radius` [m], and without, in turns.
void compare_neighbours(std::size_t count, int radius) {
    const int ticks = static_cast<int>(std::max<std::size_t>(2, 4'000 / count));
    bench::WholeEngine plain(system_text(count)), looking(system_text(count, ", radius = " + std::to_string(radius)));
    plain.run(20);
    looking.run(20);
    double seen = 0;
    for (const Robot* robot : looking.system->robots()) {
        const auto* port = static_cast<const OutPort<std::vector<Neighbour>>*>(robot->find_port("near"));
        seen += static_cast<double>(port->read().size()) / static_cast<double>(count);
    }
    std::vector<double> without, with;
    for (int round = 0; round < 15; ++round) {
        without.push_back(bench::time_of([&] { plain.run(ticks); }) / ticks);
        with.push_back(bench::time_of([&] { looking.run(ticks); }) / ticks);
    }
    std::printf("%8zu %8d %12.3f %12.3f %14.1f\n", count, radius, bench::median(without) * 1e3,
                bench::median(with) * 1e3, seen);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string_view(argv[1]) == "--profile") {
        const std::size_t count = std::strtoul(argv[2], nullptr, 10);
        bench::WholeEngine engine(system_text(count));
        const int ticks = static_cast<int>(std::max<std::size_t>(2, 200'000 / count));
        const double seconds = bench::time_of([&] { engine.run(ticks); });
        std::printf("%.2f us a robot-tick\n", seconds * 1e6 / static_cast<double>(count) / ticks);
        return 0;
    }
    std::vector<std::size_t> counts{1, 10, 100, 1000, 10'000};
    if (argc > 1) counts.assign(static_cast<std::size_t>(argc - 1), 0);
    for (int i = 1; i < argc; ++i) counts[static_cast<std::size_t>(i) - 1] = std::strtoul(argv[i], nullptr, 10);
    bench::print_header("the swarm workload: whole engine and Lua against a bare ODE loop",
                        "control 10 Hz, 10 steps of 10 ms a tick, 24 rays of 0.1 m, seed 124, one thread; CPU time, "
                        "medians of rounds in turns");
    std::puts("          robot-ticks a second                     start-up [s]");
    std::puts("  robots       bare     engine     ratio            file   + build");
    std::vector<Row> rows;
    for (const std::size_t count : counts) rows.push_back(measure(count));
    const auto find = [&](std::size_t count) {
        for (const Row& row : rows) {
            if (row.count == count) return &row;
        }
        return static_cast<const Row*>(nullptr);
    };
    const Row *ten = find(10), *thousand = find(1000), *most = find(10'000);
    if (ten != nullptr && thousand != nullptr) {
        const double growth = thousand->engine / ten->engine;
        std::printf("\na robot at 1000 costs %.2f times one at 10 (limit 1.3: %s)\n", growth,
                    bench::verdict(growth, 1.3));
    }
    if (thousand != nullptr) {
        std::printf("start-up at 1000: %.3f s (limit 0.5: %s)", thousand->start, bench::verdict(thousand->start, 0.5));
        if (most != nullptr)
            std::printf("; at 10000 a robot costs %.2f times that", most->start / thousand->start / 10);
        std::puts("");
    }
    std::puts("\nwall-clock time with 2 threads / with none, and the trace hash");
    for (const std::size_t count : counts) {
        compare_threads(count);
    }
    std::puts("\nCPU time of a tick [ms], without and with neighbours; and how many each robot sees");
    std::printf("%8s %8s %12s %12s %14s\n", "robots", "within m", "without", "with", "seen");
    for (const std::size_t count : argc > 1 ? counts : std::vector<std::size_t>{50, 1000}) {
        for (const int radius : {1, 3}) compare_neighbours(count, radius);
    }
    std::puts("\nCPU time with the ports of a small system remembered / without");
    for (const std::size_t count : counts) {
        if (count < 10'000) compare_trace(count);
    }
}

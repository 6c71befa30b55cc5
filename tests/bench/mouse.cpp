// The tutorial's mouse with the whole engine and its Lua controller, against a bare ODE loop with the same body,
// contacts, rays and steps.
//
// Limit: engine and Lua add at most 15 %. Both run in turns, and the figure is the median of the rounds' ratios. With
// `--profile`: the engine alone, for perf.
#include <cmath>

#include "engine/trace/trace.hpp"
#include "tests/bench/bare_ode.hpp"
#include "tests/bench/whole_engine.hpp"

using namespace nezumi;

namespace {

constexpr int ticks_a_round = 5000;
constexpr int rounds = 41;

constexpr bench::BareBox box{0.5, 0.6, -0.4, 0.6};
constexpr double speed = 0.1, turn = 0.8;

struct BareMouse {
    bench::BareLoop loop{bench::bare_mouse, 0.005};
    std::vector<bench::BareBox> boxes{box};

    BareMouse() { loop.add(0, 0, 0); }

    void run(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            bool blocked = false;
            for (const double distance : loop.cast_mouse_rays(0, boxes)) blocked = blocked || distance < 0.1;
            const double v = blocked ? 0 : speed, w = blocked ? 0 : turn * bench::bare_mouse.track / 2;
            loop.drive(0, v - w, v + w);
            loop.step();
            loop.step();
        }
    }
};

}  // namespace

int main(int argc, char** argv) {
    if (argc == 2 && std::string_view(argv[1]) == "--profile") {
        bench::WholeEngine engine(bench::mouse_text);
        const double seconds = bench::time_of([&] { engine.run(500'000); });
        std::printf("%.3f us a tick\n", seconds / 500'000 * 1e6);
        return 0;
    }
    bench::print_header("one mouse, Lua controller, 4 infrared rays, as fast as possible",
                        "tick 100 Hz, physics 5 ms, robot_controller.lua driving a circle, " + std::to_string(rounds) +
                            " rounds of " + std::to_string(ticks_a_round) + " ticks in turns");
    Trace trace;
    bench::WholeEngine engine(bench::mouse_text), traced(bench::mouse_text);
    trace.start(*traced.system);
    trace.remember_ports();
    BareMouse bare;
    engine.run(ticks_a_round);
    traced.run(ticks_a_round);
    bare.run(ticks_a_round);
    std::vector<double> bare_us, engine_us, ratios, trace_ratios;
    for (int round = 0; round < rounds; ++round) {
        const double a = bench::time_of([&] { bare.run(ticks_a_round); });
        const double b = bench::time_of([&] { engine.run(ticks_a_round); });
        const double c = bench::time_of([&] { traced.run(ticks_a_round); });
        trace_ratios.push_back(c / b);
        bare_us.push_back(a / ticks_a_round * 1e6);
        engine_us.push_back(b / ticks_a_round * 1e6);
        ratios.push_back(b / a);
    }
    const Truth truth = engine.system->world()->truth(0);
    const double ratio = bench::median(ratios);
    std::printf("  bare ODE loop        %7.3f us a tick\n", bench::median(bare_us));
    std::printf("  whole engine and Lua %7.3f us a tick, %.0f times real time\n", bench::median(engine_us),
                10'000 / bench::median(engine_us));
    std::printf("  ratio                %7.3f (limit 0.60: %s)\n", ratio, bench::verdict(ratio, 0.60));
    std::printf("  all ports remembered %7.3f times the engine without\n", bench::median(trace_ratios));
    std::printf("  both drive at        %7.3f and %.3f m/s\n", speed, std::hypot(truth.velocity.vx, truth.velocity.vy));
}

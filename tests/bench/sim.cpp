// The simulated world against a bare ODE loop: the swarm workload's bodies and rays, without engine and Lua.
//
// 10 steps of 10 ms a tick. "bare" are the same bodies and floor contacts in plain ODE, driving ahead. "world" has
// collisions and rays and drives by the workload's rule in C++; "no rays" is the same world with robots that turn
// blindly on the spot. Measured (two shared cores): bare / world 1.05 to 1.12 at every size.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

#include "sim/world.hpp"
#include "tests/bench/bare_ode.hpp"

using namespace nezumi;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

RobotSpec swarm_spec() {
    RobotSpec spec;
    spec.model = "disc";
    spec.mass = 1.6;
    spec.body = {BodySpec::Shape::cylinder, {0.17, 0.17, 0.06}, {0, 0, 0.04}};
    spec.drive.radius = 0.03;
    spec.drive.track = 0.14;
    spec.drive.skid = 0.07;
    for (int i = 0; i < 24; ++i) {
        SensorSpec sensor;
        sensor.name = "ray" + std::to_string(i);
        sensor.yaw = (7.5 + 15 * i) * std::numbers::pi / 180;
        sensor.at = {0.085 * std::cos(sensor.yaw), 0.085 * std::sin(sensor.yaw), 0.06};
        sensor.range = 0.1;
        spec.sensors.push_back(sensor);
    }
    return spec;
}

// The workload's controller.
Wheels control(const std::array<double, 24>& distances, const std::array<std::array<double, 2>, 24>& directions) {
    double x = 0, y = 0;
    for (std::size_t i = 0; i < 24; ++i) {
        const double d = distances[i];
        const double value = d < 0.00989 ? 1 : d > 0.1 ? 0 : 0.0100527 / (d + 0.000163144);
        x += value * directions[i][0] / 24;
        y += value * directions[i][1] / 24;
    }
    const double angle = std::atan2(y, x), length = std::hypot(x, y);
    if (std::abs(angle) <= 7.5 * std::numbers::pi / 180 && length < 0.1) return {0.05, 0.05};
    return angle > 0 ? Wheels{0.05, 0} : Wheels{0, 0.05};
}

struct Result {
    double start = 0;  // [s]
    double rate = 0;   // robot-ticks a second
    std::size_t touching = 0;
};

Result run_bare(std::size_t count, int ticks) {
    bench::BareLoop loop(bench::bare_disc, 0.01);
    for (const auto& [x, y, heading] : bench::swarm_poses(count, bench::swarm_side(count))) loop.add(x, y, heading);
    for (std::size_t i = 0; i < count; ++i) loop.drive(i, 0.05, 0.05);
    const auto begin = Clock::now();
    for (int i = 0; i < ticks * 10; ++i) loop.step();
    return {0, static_cast<double>(count) * ticks / seconds_since(begin), 0};
}

Result run_world(std::size_t count, int ticks, bool rays) {
    const auto poses = bench::swarm_poses(count, bench::swarm_side(count));
    const RobotSpec spec = swarm_spec();
    std::array<std::array<double, 2>, 24> directions;
    for (std::size_t i = 0; i < 24; ++i) directions[i] = {std::cos(spec.sensors[i].yaw), std::sin(spec.sensors[i].yaw)};
    ArenaSpec arena;
    arena.size = Point2D{bench::swarm_side(count), bench::swarm_side(count)};
    arena.border_thickness = 0.1;

    Result result;
    auto begin = Clock::now();
    auto made = sim::make_world(arena, {.step = 0.01, .seed = 124}, {});
    if (!made) std::abort();
    World& world = **made;
    std::vector<std::unique_ptr<RobotBody>> bodies;
    for (const auto& [x, y, heading] : poses) {
        auto body = world.add_robot("robot" + std::to_string(bodies.size()), spec, {{x, y}, heading});
        if (!body) {
            std::fprintf(stderr, "%s\n", body.error().message.c_str());
            std::exit(1);
        }
        bodies.push_back(std::move(*body));
    }
    result.start = seconds_since(begin);

    begin = Clock::now();
    std::array<double, 24> distances;
    distances.fill(std::numeric_limits<double>::infinity());
    for (int tick = 0; tick < ticks; ++tick) {
        for (auto& body : bodies) {
            if (rays) body->read_ranges(distances);
            // Without eyes they turn on the spot, or all would end up at the walls.
            body->set_wheel_speeds(rays ? control(distances, directions) : Wheels{-0.05, 0.05});
        }
        world.step(10);
    }
    result.rate = static_cast<double>(count) * ticks / seconds_since(begin);
    for (std::size_t i = 0; i < count; ++i) result.touching += world.collided(i) ? 1 : 0;
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t only = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 0;
    std::printf("swarm bodies and rays, 10 steps of 10 ms a tick, seed 124, one thread; robot-ticks a second\n");
    std::printf("%8s %10s %10s %10s %8s %10s %9s\n", "robots", "bare", "no rays", "world", "ratio", "start [s]",
                "touching");
    for (const std::size_t count : {1u, 10u, 100u, 1000u, 10000u}) {
        if (only != 0 && only != count) continue;
        const int ticks = static_cast<int>(std::max<std::size_t>(20, 100'000 / count));
        const Result bare = run_bare(count, ticks);
        const Result blind = run_world(count, ticks, false);
        const Result world = run_world(count, ticks, true);
        std::printf("%8zu %10.0f %10.0f %10.0f %8.2f %10.4f %9zu\n", count, bare.rate, blind.rate, world.rate,
                    bare.rate / world.rate, world.start, world.touching);
    }
}

// The simulated world against a bare ODE loop: the swarm workload's bodies and rays, without engine and Lua.
//
// 10 steps of 10 ms a tick. "bare" are the same bodies and floor contacts in plain ODE, driving ahead. "world" has
// collisions and rays and drives by the workload's rule in C++; "no rays" is the same world with robots that turn
// blindly on the spot. Measured (two shared cores): bare / world 1.02 to 1.08 at every size.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

#include "sim/simulated_body.hpp"
#include "sim/world.hpp"
#include "tests/bench/bare_ode.hpp"
#include "tests/bench/report.hpp"

using namespace nezumi;

namespace {

double seconds_since(double begin) { return bench::thread_seconds() - begin; }

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
    const double begin = bench::thread_seconds();
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
    arena.border->thickness = 0.1;

    Result result;
    double begin = bench::thread_seconds();
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

    begin = bench::thread_seconds();
    std::array<double, 24> distances;
    distances.fill(std::numeric_limits<double>::infinity());
    for (int tick = 0; tick < ticks; ++tick) {
        for (auto& body : bodies) {
            if (rays) static_cast<sim::SimulatedBody&>(*body).read_ranges(distances);
            // Without eyes they turn on the spot, or all would end up at the walls.
            body->set_wheel_speeds(rays ? control(distances, directions) : Wheels{-0.05, 0.05});
        }
        world.step(10);
    }
    result.rate = static_cast<double>(count) * ticks / seconds_since(begin);
    for (std::size_t i = 0; i < count; ++i) result.touching += world.collided(i) ? 1 : 0;
    return result;
}

RobotSpec mouse_spec() {
    RobotSpec spec;
    spec.model = "mouse";
    spec.mass = 0.72;
    spec.body = {BodySpec::Shape::box, {0.10, 0.08, 0.06}, {0, 0, 0.04}};
    const std::array<std::array<double, 3>, 4> rays{{{0.035, -0.040, 0},
                                                     {0.045, -0.030, -std::numbers::pi / 4},
                                                     {0.045, 0.030, std::numbers::pi / 4},
                                                     {0.035, 0.040, 0}}};
    for (const auto& [x, y, yaw] : rays) {
        SensorSpec sensor;
        sensor.name = "ray" + std::to_string(spec.sensors.size());
        sensor.at = {x, y, 0.04};
        sensor.yaw = yaw;
        spec.sensors.push_back(sensor);
    }
    return spec;
}

// One mouse drives circles before a wall, at the defaults: ticks of 10 ms, steps of 5 ms. Microseconds a tick.
double time_bare_mouse(int ticks) {
    bench::BareLoop loop(bench::bare_mouse, 0.005);
    loop.add(0, 0, 0);
    const std::vector<bench::BareBox> boxes{{0.75, 0.85, -0.5, 0.5}};
    double nearest = 1;
    const double begin = bench::thread_seconds();
    for (int i = 0; i < ticks; ++i) {
        for (const double distance : loop.cast_mouse_rays(0, boxes)) nearest = std::min(nearest, distance);
        loop.drive(0, nearest < 0 ? 0 : 0.05, 0.2);
        loop.step();
        loop.step();
    }
    return seconds_since(begin) / ticks * 1e6;
}

double time_mouse(int ticks) {
    ArenaSpec arena;
    arena.boxes.push_back({.at = {0.8, 0, 0.15}, .size = {0.1, 1, 0.3}});
    const RobotSpec spec = mouse_spec();
    auto made = sim::make_world(arena, {.step = 0.005, .seed = 1}, {});
    if (!made) std::abort();
    World& world = **made;
    auto body = world.add_robot("mouse", spec, {});
    if (!body) std::abort();
    std::array<double, 4> distances{};
    double nearest = 1;
    const double begin = bench::thread_seconds();
    for (int i = 0; i < ticks; ++i) {
        static_cast<sim::SimulatedBody&>(**body).read_ranges(distances);
        for (const double distance : distances) nearest = std::min(nearest, distance);
        (*body)->set_wheel_speeds({nearest < 0 ? 0 : 0.05, 0.2});
        world.step(2);
    }
    return seconds_since(begin) / ticks * 1e6;
}

void compare_mice() {
    double bare = 1e9, world = 1e9;
    for (int i = 0; i < 10; ++i) {  // in turns, the best of each: others use this machine too
        bare = std::min(bare, time_bare_mouse(20'000));
        world = std::min(world, time_mouse(20'000));
    }
    std::printf("one mouse, 4 rays, tick of 2 steps of 5 ms: bare %.3f us, world %.3f us, ratio %.3f\n\n", bare, world,
                world / bare);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t only = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 0;
    bench::print_header("the simulated world against a bare ODE loop, in robot-ticks a second",
                        "swarm bodies and rays, 10 steps of 10 ms a tick, seed 124, one thread, the best of 3 rounds");
    if (only == 0) compare_mice();
    if (argc > 1 && only == 0) return 0;
    std::printf("%8s %10s %10s %10s %8s %10s %9s\n", "robots", "bare", "no rays", "world", "ratio", "start [s]",
                "touching");
    for (const std::size_t count : {1u, 10u, 100u, 1000u, 10000u}) {
        if (only != 0 && only != count) continue;
        const int ticks = static_cast<int>(std::max<std::size_t>(20, 50'000 / count));
        // In turns, the best of each: others use this machine too.
        Result bare, blind, world;
        for (int i = 0; i < 3; ++i) {
            const auto keep_best = [](Result& best, const Result& next) {
                if (next.rate > best.rate) best = next;
            };
            keep_best(bare, run_bare(count, ticks));
            keep_best(blind, run_world(count, ticks, false));
            keep_best(world, run_world(count, ticks, true));
        }
        std::printf("%8zu %10.0f %10.0f %10.0f %8.2f %10.4f %9zu\n", count, bare.rate, blind.rate, world.rate,
                    bare.rate / world.rate, world.start, world.touching);
    }
}

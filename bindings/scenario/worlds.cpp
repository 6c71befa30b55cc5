// The common clock goes to the next tick of any world.
#include "bindings/scenario/worlds.hpp"

#include <algorithm>
#include <cmath>

#include "bindings/scenario/expectation.hpp"

namespace nezumi {
namespace {

bool all_stand(const System& system) {
    const auto robots = system.robots();
    return std::all_of(robots.begin(), robots.end(),
                       [](const Robot* robot) { return robot->guard().current() == Velocity2D{}; });
}

}  // namespace

void Worlds::World::tick(Spectator* spectator) {
    if (is_real()) {
        if (!pacer) pacer.emplace(live->system().settings().rate, 1);
        pacer->wait();
    }
    if (spectator != nullptr)
        spectator->tick(*live);
    else
        live->tick();
    ++ticks;
}

RunningSystem& Worlds::add(std::unique_ptr<RunningSystem> world) {
    const double passed = world->system().settings().real_time ? world->system().now().seconds : 0;
    RunningSystem* const live = world.get();
    worlds_.push_back({std::move(world), live, now_ - passed, 0});
    return *live;
}

RunningSystem& Worlds::add(std::unique_ptr<RecordedWorld> recording) {
    RunningSystem* const live = &recording->live();
    worlds_.push_back({nullptr, live, now_, 0, std::move(recording)});
    return *live;
}

void Worlds::stop_robots() {
    constexpr double longest = 1;  // [s]
    for (World& world : worlds_) {
        if (!world.is_real()) continue;
        world.live->end();
        const double end = world.now() + longest;
        do {
            world.tick(nullptr);
        } while (world.now() < end && !all_stand(world.live->system()));
    }
}

double Worlds::next() const {
    double soonest = std::numeric_limits<double>::infinity();
    for (const World& world : worlds_) soonest = std::min(soonest, world.next());
    return soonest;
}

Expected<std::vector<std::size_t>> Worlds::step() {
    for (World& world : worlds_) {
        if (world.recording == nullptr || world.has_ended || world.next() > next() + time_tolerance) continue;
        const auto more = world.recording->before_tick();
        if (!more) return Unexpected(more.error());
        world.has_ended = !*more;
    }
    const double then = next();
    std::vector<std::size_t> ticked;
    if (std::isinf(then)) return ticked;
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
        World& world = worlds_[i];
        if (world.next() > then + time_tolerance) continue;
        world.tick(i == 0 ? spectator_ : nullptr);
        ticked.push_back(i);
        if (const auto& error = world.live->system().fatal_error()) return Unexpected(*error);
    }
    now_ = worlds_.front().is_real() ? worlds_.front().now() : then;
    return ticked;
}

std::int64_t Worlds::ticks() const {
    std::int64_t all = 0;
    for (const World& world : worlds_) all += world.ticks;
    return all;
}

std::uint64_t Worlds::trace_hash() const {
    if (worlds_.size() == 1) return worlds_.front().live->trace_hash();
    std::uint64_t hash = 0;
    for (const World& world : worlds_) hash = mix(hash, world.live->trace_hash());
    return hash;
}

}  // namespace nezumi

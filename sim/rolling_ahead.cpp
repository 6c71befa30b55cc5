// Advances robots step by step in closed form, within registers and the nearest cache.
#include "sim/rolling_ahead.hpp"

#include <algorithm>
#include <array>

#include "engine/base/worker_pool.hpp"
#include "sim/free_rolling.hpp"
#include "sim/lanes.hpp"

namespace nezumi::sim {
namespace {

// With fewer robot-steps than this, one thread is faster: waking another thread takes as long as these steps.
constexpr std::size_t worth_threads = 500;

}  // namespace

// Calls `action(begin, end, thread)` for shares of the robots; each robot takes `steps` steps.
template <class Action>
void RollingAhead::share_out(int steps, const Action& action) {
    const std::size_t count = movers_.robots.size();
    if (workers_ == nullptr || count * static_cast<std::size_t>(steps) < worth_threads) {
        action(std::size_t{0}, count, std::size_t{0});
    } else {
        workers_->run(count, action);
    }
}

// Robots of one model, at most one per lane. Only robots that roll freely to the end are moved.
void RollingAhead::roll(std::span<const std::size_t> robots, int steps, std::vector<double>& fastest) {
    std::array<Rolling, Lanes::count> all;
    const std::span<Rolling> rolling = std::span(all).first(robots.size());
    for (std::size_t k = 0; k < robots.size(); ++k)
        rolling[k] = {before_[robots[k]].body, movers_.robots[robots[k]].speeds};
    const RobotModel& model = *movers_.robots[robots.front()].model;
    roll_freely(model, rolling, step_, std::span(fastest).first(static_cast<std::size_t>(steps)));
    for (std::size_t k = 0; k < rolling.size(); ++k) {
        const auto& [body, speeds, rolls] = rolling[k];
        is_ahead_[robots[k]] = rolls ? 1 : 0;
        if (!rolls) continue;
        SimRobot& robot = movers_.robots[robots[k]];
        robot.leave_to_ode(false);
        robot.body.arrive(body);
        robot.angles = before_[robots[k]].angles;
        robot.turn_wheels(step_, steps);
        place_hull(scene_.mover(robot.mover), model, body.centre, body.rotation);
    }
}

// Moves the robots of [begin, end) for which `wanted` is true, from their states in `before_`.
template <class Wanted>
void RollingAhead::roll_all(std::size_t begin, std::size_t end, int steps, std::vector<double>& fastest,
                            const Wanted& wanted) {
    std::array<std::size_t, Lanes::count> together{};
    std::size_t count = 0;
    const auto try_them = [&] {
        if (count > 0) roll(std::span(together).first(count), steps, fastest);
        count = 0;
    };
    for (std::size_t i = begin; i < end; ++i) {
        if (!wanted(i)) continue;
        if (count > 0 && movers_.robots[together[0]].model != movers_.robots[i].model) try_them();
        together[count++] = i;
        if (count == Lanes::count) try_them();
    }
    try_them();
}

void RollingAhead::go(int steps) {
    taken_ = steps;
    before_.resize(movers_.robots.size());
    is_ahead_.resize(movers_.robots.size());
    fastest_of_.resize(workers_ != nullptr ? workers_->size() : 1);
    for (auto& fastest : fastest_of_) fastest.assign(static_cast<std::size_t>(steps), 0.0);
    share_out(steps, [this](std::size_t begin, std::size_t end, std::size_t thread) {
        roll_all(begin, end, taken_, fastest_of_[thread], [this](std::size_t i) {
            const SimRobot& robot = movers_.robots[i];
            is_ahead_[i] = 0;
            if (robot.gone || robot.has_neighbours || !robot.may_roll()) return false;
            before_[i] = {robot.body.state(), robot.angles};
            return true;
        });
    });
    fastest_.assign(static_cast<std::size_t>(steps), 0.0);
    for (const auto& fastest : fastest_of_) {
        std::transform(fastest.begin(), fastest.end(), fastest_.begin(), fastest_.begin(),
                       [](double a, double b) { return std::max(a, b); });
    }
    others_.clear();
    for (std::size_t i = 0; i < is_ahead_.size(); ++i) {
        if (is_ahead_[i] == 0 && !movers_.robots[i].gone) others_.push_back(&movers_.robots[i]);
    }
}

void RollingAhead::go_back_to(int steps) {
    if (steps == taken_) return;
    share_out(steps, [&](std::size_t begin, std::size_t end, std::size_t thread) {
        roll_all(begin, end, steps, fastest_of_[thread], [this](std::size_t i) { return is_ahead_[i] != 0; });
    });
}

}  // namespace nezumi::sim

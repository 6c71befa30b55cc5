// Step after step in closed form, in registers and the nearest cache.
#include "sim/rolling_ahead.hpp"

#include <algorithm>

#include "engine/base/worker_pool.hpp"
#include "sim/free_rolling.hpp"

namespace nezumi::sim {
namespace {

// Fewer steps of robots than this are quicker on one thread: a thread that sleeps takes as long to come.
constexpr std::size_t worth_threads = 2000;

}  // namespace

// Calls `action(begin, end, thread)` for shares of the robots, for each of whom it takes the time of so many steps.
template <class Action>
void RollingAhead::share_out(int steps, const Action& action) {
    const std::size_t count = movers_.robots.size();
    if (workers_ == nullptr || count * static_cast<std::size_t>(steps) < worth_threads) {
        action(std::size_t{0}, count, std::size_t{0});
    } else {
        workers_->run(count, action);
    }
}

// Whether it rolls freely all the way; then `to` is where it gets to.
bool RollingAhead::roll(const SimRobot& robot, int steps, Ahead& to, std::vector<double>& fastest) const {
    if (robot.gone || robot.has_neighbours || !robot.may_roll()) return false;
    to = {robot.body.state(), robot.angles};
    const Wheels turned = robot.turned(step_);
    for (int i = 0; i < steps; ++i) {
        const auto motion = roll_freely(*robot.model, to.body, robot.speeds, step_);
        if (!motion) return false;
        to.body.advance(*motion, step_);
        to.angles.left += turned.left;
        to.angles.right += turned.right;
        double& most = fastest[static_cast<std::size_t>(i)];
        most = std::max(most, motion->velocity.squaredNorm());
    }
    return true;
}

void RollingAhead::look(int steps) {
    looked_at_ = steps;
    ahead_.resize(movers_.robots.size());
    is_ahead_.resize(movers_.robots.size());
    fastest_of_.resize(workers_ != nullptr ? workers_->size() : 1);
    for (auto& fastest : fastest_of_) fastest.assign(static_cast<std::size_t>(steps), 0.0);
    share_out(steps, [this](std::size_t begin, std::size_t end, std::size_t thread) {
        for (std::size_t i = begin; i < end; ++i) {
            SimRobot& robot = movers_.robots[i];
            is_ahead_[i] = roll(robot, looked_at_, ahead_[i], fastest_of_[thread]) ? 1 : 0;
            if (is_ahead_[i] != 0) robot.leave_to_ode(false);
        }
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

void RollingAhead::arrive(int steps) {
    const bool is_early = steps < looked_at_;
    share_out(is_early ? steps : 1, [&](std::size_t begin, std::size_t end, std::size_t thread) {
        for (std::size_t i = begin; i < end; ++i) {
            if (is_ahead_[i] == 0) continue;
            SimRobot& robot = movers_.robots[i];
            if (is_early) roll(robot, steps, ahead_[i], fastest_of_[thread]);
            robot.body.arrive(ahead_[i].body);
            robot.angles = ahead_[i].angles;
            place_hull(scene_.mover(robot.mover), *robot.model, ahead_[i].body.centre, ahead_[i].body.rotation);
        }
    });
}

}  // namespace nezumi::sim

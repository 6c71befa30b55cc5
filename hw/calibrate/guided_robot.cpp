// While the robot rests, it is not ACTIVE: no ticks are needed while a person reads, measures and carries the robot.
#include "hw/calibrate/guided_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/list.hpp"

namespace nezumi::hw {
namespace {

constexpr double longest_braking = 3;  // [s]

InPort<Velocity2D>* velocity_in(Robot& robot) {
    for (const PortSpec& port : robot.spec().ports) {
        if (port.is_input && contains(port.items, "drive"))
            return static_cast<InPort<Velocity2D>*>(robot.find_in_port(port.name));
    }
    return nullptr;
}

}  // namespace

Expected<std::unique_ptr<GuidedRobot>> GuidedRobot::make(SystemSpec spec, const std::string& name, const Makers& makers,
                                                         Options options) {
    std::erase_if(spec.entries, [&](const Entry& entry) {
        return !std::holds_alternative<RobotEntry>(entry) || name_of(entry) != name;
    });
    spec.connections.clear();
    std::unique_ptr<GuidedRobot> guided(new GuidedRobot(std::move(spec), std::move(options)));
    // In the first tick after a rest nothing is logged: the pause before this tick is not a fault.
    BuildOptions build{.real_time = guided->options_.real_time, .log = [owner = guided.get()](const LogLine& line) {
                           if (owner->options_.log && !owner->is_waking_) owner->options_.log(line);
                       }};
    auto system = build_system(guided->spec_, makers, build);
    if (!system) return Unexpected(system.error());
    guided->system_ = std::move(*system);
    if (guided->system_->robots().empty()) return failure(fmt::format("there is no robot '{}'", shown(name)));
    guided->robot_ = guided->system_->robots().front();
    guided->velocity_ = velocity_in(*guided->robot_);
    if (guided->velocity_ == nullptr)
        return failure(
            fmt::format("robot '{}' has no port that drives it: expected an in-port with to = \"drive\"", name));
    guided->pacer_ = std::make_unique<Pacer>(guided->spec_.rate, 1);
    return guided;
}

GuidedRobot::~GuidedRobot() {
    if (robot_ != nullptr) rest();
}

void GuidedRobot::tick() {
    if (options_.real_time) pacer_->wait();
    system_->tick();
}

void GuidedRobot::rest() {
    if (robot_->state() != LifeState::active) return;
    static_cast<void>(robot_->deactivate(system_->now()));
    const double begin = system_->now().seconds;
    // The motors are switched off a moment after the robot stops.
    constexpr double powering_off = 0.7;  // [s]
    while (system_->now().seconds < begin + powering_off) tick();
}

Expected<void> GuidedRobot::drive(const Velocity2D& velocity, double seconds, const std::function<bool()>& reached,
                                  const EachTick& each_tick) {
    if (robot_->state() != LifeState::active) {
        pacer_->restart();
        is_waking_ = true;
        tick();
        is_waking_ = false;
        if (auto ok = robot_->activate(system_->now()); !ok) return ok;
    }
    const auto should_end = [&] { return options_.end != nullptr && *options_.end != 0; };
    const auto step = [&](const Velocity2D& wanted) {
        velocity_->inject(wanted);
        tick();
        if (each_tick) each_tick();
    };
    const double begin = system_->now().seconds;
    while (!should_end() && system_->now().seconds < begin + seconds && !(reached && reached())) step(velocity);
    if (options_.end != nullptr && *options_.end == SIGTERM) robot_->halt();
    const double end = system_->now().seconds + longest_braking;
    while (system_->now().seconds < end && !robot_->stands()) step({});
    if (!should_end()) return {};
    rest();
    return failure("interrupted: the robot has stopped");
}

}  // namespace nezumi::hw

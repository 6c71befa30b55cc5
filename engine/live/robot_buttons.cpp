// The functions are called between two ticks, and use the sensor readings of the last tick.
#include "engine/live/robot_buttons.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/base/program.hpp"
#include "engine/robot/robot.hpp"

namespace nezumi {
namespace {

// True if this button of a real robot is pressed; "" means no button.
bool is_pressed(const Robot& robot, const std::string& button) {
    const RobotSpec& spec = robot.spec();
    for (std::size_t i = 0; robot.is_real() && i < spec.sensors.size() && i < robot.readings().size(); ++i) {
        const SensorReading& reading = robot.readings()[i];
        if (!button.empty() && spec.sensors[i].name == button) return reading.is_there && reading.value != 0;
    }
    return false;
}

}  // namespace

ShutdownButtons::ShutdownButtons(RunLoop& loop, std::function<void(std::string)> say)
    : loop_(loop), say_(std::move(say)) {
    if (loop.is_hardware()) loop.after_tick([this] { after_tick(); });
}

void ShutdownButtons::after_tick() {
    const System& system = loop_.live().system();
    for (const Robot* robot : system.robots()) {
        if (!is_pressed(*robot, robot->spec().hardware.shutdown)) {
            pressed_at_.erase(robot->name());
            continue;
        }
        const double since = pressed_at_.try_emplace(robot->name(), system.now().seconds).first->second;
        if (system.now().seconds - since < long_press || std::exchange(is_wanted_, true)) continue;
        say_(fmt::format("{}: {} was held for {} s: the run ends, and the computer is shut down", robot->name(),
                         robot->spec().hardware.shutdown, long_press));
        loop_.quit();
    }
}

void ShutdownButtons::finish() const {
    if (!is_wanted_) return;
    if (const std::string problem = problem_of(run_program({.words = {"systemctl", "poweroff"}})); !problem.empty())
        say_(fmt::format("the computer can't be shut down: systemctl poweroff: {}. Try: sudo systemctl poweroff",
                         problem));
}

StartButtons::StartButtons(RunLoop& loop, std::function<void(std::string)> say) : loop_(loop), say_(std::move(say)) {
    for (const Robot* robot : loop.live().system().robots()) {
        const std::string& button = robot->spec().hardware.start;
        if (!robot->is_real() || button.empty()) continue;
        waiting_.push_back(robot->name());
        say_(fmt::format("{} WAITS: PRESS {} ON THE ROBOT, and it starts to move", robot->name(), button));
    }
    if (waiting_.empty()) return;
    loop_.pause();
    loop_.after_tick([this] { after_tick(); });
}

void StartButtons::after_tick() {
    if (waiting_.empty()) return;
    if (!loop_.is_paused()) {
        waiting_.clear();  // the user has resumed the run at the console
        return;
    }
    std::erase_if(waiting_, [this](const std::string& name) {
        const Robot* robot = loop_.live().system().find_robot(name);
        if (robot == nullptr) return true;
        if (!is_pressed(*robot, robot->spec().hardware.start)) return false;
        say_(name + " starts");
        return true;
    });
    if (waiting_.empty()) loop_.resume();
}

}  // namespace nezumi

// From simulated robots to real ones, before the system is built.
#include "bindings/cli/run_hardware.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "engine/system/build_system.hpp"
#include "hw/drivers.hpp"

namespace nezumi::cli {
namespace {

Expected<void> check_names(const SystemSpec& spec, const std::vector<std::string>& robots) {
    std::vector<std::string_view> known;
    for (const Entry& entry : spec.entries) {
        if (const auto* robot = std::get_if<RobotEntry>(&entry)) known.push_back(robot->name);
    }
    for (const std::string& name : robots) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        return failure(
            fmt::format("--hw: there is no robot '{}' in {}{}", shown(name), spec.file, did_you_mean(name, known)));
    }
    return {};
}

// The button that starts this robot; nothing when it starts at once.
const SensorReading* start_button(const Robot& robot) {
    const RobotSpec& spec = robot.spec();
    if (!robot.is_real() || spec.hardware.start.empty()) return nullptr;
    for (std::size_t i = 0; i < spec.sensors.size() && i < robot.readings().size(); ++i) {
        if (spec.sensors[i].name == spec.hardware.start) return &robot.readings()[i];
    }
    return nullptr;
}

}  // namespace

Expected<void> choose_drivers(SystemSpec& spec, const std::vector<std::string>& robots) {
    if (auto ok = check_names(spec, robots); !ok) return ok;
    bool any = false;
    for (Entry& entry : spec.entries) {
        auto* robot = std::get_if<RobotEntry>(&entry);
        if (robot == nullptr) continue;
        const bool named = std::find(robots.begin(), robots.end(), robot->name) != robots.end();
        if (!robots.empty() && !named) continue;
        if (robot->backend == simulated) {
            if (named)
                return failure(fmt::format("robot '{}': --hw={} wants the real one, and backend = \"sim\" keeps it "
                                           "simulated",
                                           robot->name, robot->name),
                               robot->place);
            continue;
        }
        if (robot->backend.empty()) {
            const auto model = spec.models.find(robot->model);
            const std::string driver = model == spec.models.end() ? "" : model->second.hardware.driver;
            if (driver.empty())
                return failure(
                    fmt::format("robot '{}': its model '{}' names no driver: add hardware = {{ driver = ... }} "
                                "to the model, or keep the robot simulated by backend = \"sim\"",
                                robot->name, robot->model),
                    robot->place);
            robot->backend = driver;
        }
        any = true;
    }
    if (!any) return failure(fmt::format("--hw: {} has no robot that could be real", spec.file));
    if (spec.rate < slowest_hardware_rate)
        return failure(fmt::format("--hw: {} ticks a second are too few to drive a real robot: expected {} or more",
                                   spec.rate, slowest_hardware_rate),
                       spec.rate_place);
    return {};
}

void use_hardware(LiveOptions& live, const Hardware& hardware) {
    live.bodies = hw::drivers({.dev = hardware.dev_root, .sys = hardware.sys_root});
    live.prepare = [robots = hardware.robots](SystemSpec& spec) { return choose_drivers(spec, robots); };
    live.build.real_time = true;
    live.build.out_of_time_is_fatal = false;
    live.budget = paced_budget;
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
        waiting_.clear();  // somebody at the console knows what they do
        return;
    }
    std::erase_if(waiting_, [this](const std::string& name) {
        const Robot* robot = loop_.live().system().find_robot(name);
        if (robot == nullptr) return true;
        const SensorReading* button = start_button(*robot);
        if (button == nullptr || !button->is_there || button->value == 0) return false;
        say_(name + " starts");
        return true;
    });
    if (waiting_.empty()) loop_.resume();
}

}  // namespace nezumi::cli

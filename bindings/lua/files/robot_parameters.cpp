// A robot's parameters are fields of its description, which a system file may change.
#include "bindings/lua/files/robot_parameters.hpp"

#include <fmt/format.h>

#include <utility>

#include "bindings/lua/files/change_robot.hpp"
#include "engine/robot/robot_parameters.hpp"

namespace nezumi {
namespace {

Value table_with(std::string name, Value value) {
    FileTable table;
    table.fields.push_back({std::move(name), std::move(value)});
    return {std::move(table)};
}

const RobotSpec& description_of(const SystemSpec& spec, const RobotEntry& robot) {
    return spec.models.at(robot.described_by());
}

}  // namespace

Expected<Value> field_of_parameter(const RobotSpec& robot, const std::string& parameter, const Value& value) {
    Parameters parameters;
    std::string carrier;
    for (const ActuatorSpec& actuator : robot.actuators) {
        auto speed = speed_parameter(actuator);
        if (!speed) continue;
        if (speed->name == parameter) carrier = actuator.name;
        if (auto ok = parameters.declare(std::move(*speed)); !ok) return Unexpected(ok.error());
    }
    if (parameters.all().empty()) return failure("this robot has no parameters");
    if (auto ok = parameters.set(parameter, value); !ok) return Unexpected(ok.error());
    const Value speed{parameters.find(parameter)->value.get<double>()};
    return table_with("actuators", table_with(carrier, table_with("speed", speed)));
}

Expected<void> set_robot_parameter(SystemSpec& spec, const std::string& robot, const std::string& parameter,
                                   const Value& value, const Place& place, const Project& project) {
    const RobotEntry* entry = find_entry<RobotEntry>(spec, robot);
    if (entry == nullptr) return failure(fmt::format("there is no robot '{}'", robot), place);
    const auto field = field_of_parameter(description_of(spec, *entry), parameter, value);
    if (!field) return failure(fmt::format("{}: {}", robot, field.error().message), place);
    FieldCheck check(fmt::format("robot '{}'", robot), "robot", place, nullptr);
    if (auto ok = change_robot(spec, robot, *field, check, project); !ok) return ok;
    return check.result();
}

Expected<void> take_robot_parameters(SystemSpec& spec, const std::string& robot, const SystemSpec& saved,
                                     const RobotEntry& from, const Project& project) {
    for (const ActuatorSpec& actuator : description_of(saved, from).actuators) {
        const auto speed = speed_parameter(actuator);
        if (!speed) continue;
        const RobotEntry* entry = find_entry<RobotEntry>(spec, robot);
        bool is_same = false;
        for (const ActuatorSpec& own : description_of(spec, *entry).actuators)
            is_same = is_same || (own.name == actuator.name && own.speed == actuator.speed);
        if (is_same) continue;
        if (auto ok = set_robot_parameter(spec, robot, speed->name, speed->initial, from.place, project); !ok)
            return ok;
    }
    return {};
}

}  // namespace nezumi

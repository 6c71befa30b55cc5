// Writes an explained execution field by field.
#include "bindings/web/explain_json.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace nezumi::web {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<Explanation::PortValue>& ports) {
    Json json = Json::array();
    for (const auto& port : ports)
        json.push_back(
            {{"port", port.port}, {"value", port.value}, {"peers", port.peers}, {"override", port.override}});
    return json;
}

Json to_json(const TracedLines::Line& line) {
    Json values = Json::array();
    for (const TracedLines::Value& value : line.values) values.push_back(Json::array({value.name, value.text}));
    return {{"file", line.file}, {"line", line.line},           {"depth", line.depth},
            {"text", line.text}, {"values", std::move(values)}, {"turns_left_out", line.turns_left_out}};
}

Json to_json(const Velocity2D& velocity) { return {{"vx", velocity.vx}, {"va", velocity.va}}; }

Json to_json(const Explanation::OfRobot& robot) {
    return {{"robot", robot.robot},
            {"asked", to_json(robot.asked)},
            {"limits", {{"speed", robot.speed}, {"yaw_rate", robot.yaw_rate}}},
            {"limited", to_json(robot.limited)},
            {"wheels", robot.wheels_told ? Json{{"left", robot.wheels.left}, {"right", robot.wheels.right}} : Json()}};
}

}  // namespace

Json explanation_to_json(const Explanation& explanation) {
    Json json{{"is", "explain"},
              {"component", explanation.component},
              {"tick", explanation.tick},
              {"at", explanation.seconds},
              {"inputs", to_json(explanation.inputs)},
              {"lines", Json::array()},
              {"is_cut", explanation.traced.is_cut},
              {"outputs", to_json(explanation.outputs)},
              {"robots", Json::array()}};
    for (const TracedLines::Line& line : explanation.traced.lines) json["lines"].push_back(to_json(line));
    for (const Explanation::OfRobot& robot : explanation.robots) json["robots"].push_back(to_json(robot));
    return json;
}

}  // namespace nezumi::web

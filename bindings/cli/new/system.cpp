// Texts as a person would write them, with aligned columns.
#include "bindings/cli/new/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bindings/cli/new/arguments.hpp"
#include "engine/base/lua_text.hpp"

namespace nezumi::cli {
namespace {

using Pair = std::pair<std::string, std::string>;

// Splits "mouse=raspimouse" into a name and a value.
Expected<std::vector<Pair>> read_pairs(std::string_view option, const std::vector<std::string>& given,
                                       std::string_view form, std::string_view example) {
    std::vector<Pair> pairs;
    for (const std::string& text : given) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
            return failure(
                fmt::format("{0} '{1}': expected {2}, for example {0} {3}", option, shown(text), form, example));
        }
        pairs.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return pairs;
}

// Robots start side by side at this distance.
constexpr double apart = 0.4;  // [m]

}  // namespace

Expected<std::string> system_text(const NewSystem& wanted) {
    auto robots = read_pairs("--robot", wanted.robots, "NAME=MODEL", "mouse=raspimouse");
    if (!robots) return Unexpected(robots.error());
    auto behaviors = read_pairs("--behavior", wanted.behaviors, "NAME=SCRIPT", "controller=robot_controller");
    if (!behaviors) return Unexpected(behaviors.error());
    const auto connections =
        read_pairs("--connect", wanted.connections, "FROM=TO", "controller.out=mouse.target_velocity_in");
    if (!connections) return Unexpected(connections.error());
    if (robots->empty()) robots->emplace_back("mouse", "raspimouse");
    std::vector<std::string> taken;
    std::size_t width = 0;
    for (const auto& [option, pairs] : {std::pair{"--robot", &*robots}, {"--behavior", &*behaviors}}) {
        for (const auto& [name, what] : *pairs) {
            if (auto ok = take_new_name(option, name, taken); !ok) return Unexpected(ok.error());
            width = std::max(width, lua_quoted(name).size());
        }
    }

    std::string text = fmt::format(
        "--- {}: say in a sentence what it is for.\narena {{\n  size = {{ 2.0, 2.0 }},\n}}\n\n", wanted.name);
    for (std::size_t i = 0; i < robots->size(); ++i) {
        const auto& [name, model] = (*robots)[i];
        const double y = (static_cast<double>(i) - static_cast<double>(robots->size() - 1) / 2) * apart;
        text += fmt::format("robot    {:{}} {{ model = {}, pose = {{ x = 0, y = {:.6g}, heading = 0 }} }}\n",
                            lua_quoted(name), width, lua_quoted(model), y);
    }
    for (const auto& [name, script] : *behaviors)
        text += fmt::format("behavior {:{}} {{ script = {} }}\n", lua_quoted(name), width, lua_quoted(script));
    if (!connections->empty()) text += "\n";
    for (const auto& [from, to] : *connections)
        text += fmt::format("connect({}, {})\n", lua_quoted(from), lua_quoted(to));
    return text;
}

std::string robot_text(const std::string& name) {
    return fmt::format(R"lua(--- {0}: say in a sentence what it is.

--- A distance sensor: its position from the chassis' centre [m] and its direction [degrees, left positive].
local function eye(x, y, degrees)
  return {{ kind = "range", at = {{ x, y }}, yaw = math.rad(degrees), range = 0.8, noise = 0.005 }}
end

return robot_model {{
  doc = "{0}: two wheels, three distance sensors, a bumper",
  mass = 0.8,                                                     -- kg
  body = {{ shape = "cylinder", radius = 0.07, height = 0.06 }},    -- m
  drive = {{
    radius = 0.03,                                                -- m, of the wheels
    track = 0.12,                                                 -- m, between them
    limits = {{ speed = 0.5, yaw_rate = 4, acceleration = 2, yaw_acceleration = 12 }},
  }},

  sensors = {{
    left   = eye(0.05, 0.05, 45),
    front  = eye(0.07, 0, 0),
    right  = eye(0.05, -0.05, -45),
    bumper = {{ kind = "touch", at = {{ 0.07, 0 }} }},
  }},

  ports = {{
    velocity  = {{ type = "TimedVelocity2D", to = "drive", doc = "target velocity" }},
    pose      = {{ type = "TimedPose2D", from = "odometry", doc = "pose by odometry" }},
    distances = {{ type = "TimedDoubleSeq", from = {{ "left", "front", "right" }}, doc = "in metres" }},
    touched   = {{ type = "TimedBooleanSeq", from = {{ "bumper" }}, doc = "whether the bumper is pressed" }},
  }},
}}
)lua",
                       name);
}

std::string system_scenario_text(const std::string& name, const std::string& path, const SystemSpec& system) {
    std::string text = fmt::format(
        "scenario({}, {{ timeout = 30 }}, function(s)\n"
        "  local world = s:load {}\n\n",
        lua_quoted(name + " runs well"), lua_quoted(path));
    for (const Entry& entry : system.entries) {
        const std::string& its = name_of(entry);
        if (const auto* behavior = std::get_if<BehaviorEntry>(&entry); behavior != nullptr && behavior->active) {
            text +=
                fmt::format("  s:always(\"{0} is well\", function() return world.{0}.status == \"ACTIVE\" end)\n", its);
        } else if (std::holds_alternative<RobotEntry>(entry)) {
            text += fmt::format("  s:never(\"{0} touches anything\", function() return world.{0}.collided end)\n", its);
        }
    }
    return text + "  s:run(10)\nend)\n";
}

}  // namespace nezumi::cli

// The templates of a project. Files for editors are made from the bindings' own descriptions.
#include "bindings/cli/new/project.hpp"

#include <fmt/format.h>

#include <string_view>

#include "bindings/cli/base/environment.hpp"
#include "bindings/cli/base/json_text.hpp"
#include "bindings/lua/stubs/annotations.hpp"
#include "bindings/scenario/scenario_fields.hpp"
#include "engine/components/component.hpp"

namespace nezumi::cli {
namespace {

constexpr std::string_view behavior = R"lua(--- Drives ahead, and turns while something is near.

local eyes   = input("eyes", "TimedShortSeq", "distance sensors; a larger value is nearer")
local wheels = output("wheels", "TimedVelocity2D", "target velocity")

param("speed", 0.2, { min = 0.0, max = 0.5, step = 0.01, widget = "slider", unit = "m/s", doc = "when the way is free" })
param("turn", 2.0, { min = -6.0, max = 6.0, step = 0.1, widget = "slider", unit = "rad/s", doc = "when it is not" })
param("near", 60, { min = 0, max = 4095, doc = "a sensor value above this is near" })

local function is_near()
  for _, value in ipairs(eyes:read()) do
    if value > config.near then return true end
  end
  return false
end

function on_execute()
  if is_near() then
    wheels:write { va = config.turn }
  else
    wheels:write { vx = config.speed }
  end
end
)lua";

constexpr std::string_view system = R"lua(--- A mouse explores a room with a box in it.
arena {
  size = { 2.0, 2.0 },
  box { at = { 0.6, 0.3 }, size = { 0.2, 0.2, 0.1 } },
}

robot    "mouse"    { model = "raspimouse" }
behavior "explorer" { script = "explorer" }

connect("mouse.ir_sensor_out", "explorer.eyes")
connect("explorer.wheels", "mouse.target_velocity_in")
)lua";

constexpr std::string_view scenario =
    R"lua(scenario("explores the room and touches nothing", { timeout = 60 }, function(s)
  local world = s:load "systems/room.lua"

  s:never("touches anything", function() return world.mouse.collided end)
  s:wait_until("under way", { within = 5 }, function() return world.mouse.truth.velocity.vx > 0.1 end)
  s:eventually("turns", { within = 30 }, function() return world.mouse.truth.velocity.va > 1 end)
  s:run(20)
end)
)lua";

constexpr std::string_view extensions = R"json({
  "recommendations": ["sumneko.lua"]
}
)json";

constexpr std::string_view tasks = R"json({
  "version": "2.0.0",
  "tasks": [
    {
      "label": "nezumi check",
      "type": "shell",
      "command": "nezumi check .",
      "group": "build",
      "problemMatcher": {
        "owner": "nezumi",
        "fileLocation": ["autoDetect", "${workspaceFolder}"],
        "pattern": {
          "regexp": "^(.+?\\.\\w+):(\\d+):(?:(\\d+):)? (.*)$",
          "file": 1, "line": 2, "column": 3, "message": 4
        }
      }
    },
    {
      "label": "nezumi test",
      "type": "shell",
      "command": "nezumi test",
      "group": { "kind": "test", "isDefault": true },
      "problemMatcher": []
    }
  ]
}
)json";

// Settings of the Lua language server: the callbacks of behaviours, without the libraries that the sandbox lacks.
std::string luarc() {
    std::string callbacks;
    for (const std::string_view name : hook_names())
        callbacks += fmt::format("{}{}", callbacks.empty() ? "" : ", ", json_text(name));
    return "{\n"
           "  \"runtime.version\": \"Lua 5.4\",\n"
           "  \"runtime.plugin\": \".nezumi/plugin.lua\",\n"
           "  \"runtime.builtin\": { \"os\": \"disable\", \"io\": \"disable\", \"debug\": \"disable\", \"package\": "
           "\"disable\" },\n"
           "  \"workspace.library\": [\".nezumi/library\"],\n"
           "  \"workspace.checkThirdParty\": false,\n"
           "  \"diagnostics.globals\": [" +
           callbacks + "]\n}\n";
}

std::string readme(const std::string& name) {
    return fmt::format(R"md(# {}

What small robots do, in Lua, with nezumi.

    nezumi run behaviors/systems/room.lua     # simulate it; edit behaviors/explorer.lua meanwhile
    nezumi test                               # run the scenarios in tests/
    nezumi check .                            # say what is wrong, without running
    nezumi new behavior follower --in eyes:TimedShortSeq --out wheels:TimedVelocity2D --param speed=0.1

| folder | holds |
|---|---|
| `behaviors/` | behaviours: one file is one component type |
| `behaviors/systems/` | systems: which robots and behaviours there are, and how they are wired |
| `tests/` | scenarios: what must hold |
| `.nezumi/` | what the Lua language server needs; after an update of nezumi: `nezumi types --lua > .nezumi/library/nezumi.lua` |
)md",
                       name);
}

}  // namespace

std::vector<NewFile> project_files(const std::string& name) {
    return {
        {"behaviors/explorer.lua", std::string(behavior)},
        {"behaviors/systems/room.lua", std::string(system)},
        {"tests/explorer_test.lua", std::string(scenario)},
        {"README.md", readme(name)},
        {".gitignore", "# Traces and pictures of failed scenarios.\n/nezumi-test/\n"},
        {".luarc.json", luarc()},
        {".nezumi/library/nezumi.lua", annotations(scenario_records(), peer_words())},
        {".nezumi/plugin.lua", annotations_plugin},
        {".vscode/extensions.json", std::string(extensions)},
        {".vscode/tasks.json", std::string(tasks)},
    };
}

}  // namespace nezumi::cli

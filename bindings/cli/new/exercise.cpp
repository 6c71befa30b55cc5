// The templates of an exercise: a mouse that must drive to a line.
#include "bindings/cli/new/exercise.hpp"

#include <fmt/format.h>

#include <string_view>

namespace nezumi::cli {
namespace {

constexpr std::string_view exercise_text = R"md(# {0}

The mouse does not move. Change `behaviors/driver.lua` so that it drives forward.

1. Open **Editor** and the file `driver.lua`.
2. Write a velocity: `wheels:write {{ vx = 0.1 }}`.
3. Press Ctrl-S. The new version runs at once.
)md";

constexpr std::string_view exercise_text_ja = R"md(# {0}

マウスは止まっています。`behaviors/driver.lua` を書き換えて、前に走らせましょう。

1. **エディタ**で `driver.lua` を開きます。
2. 速度を出力します: `wheels:write {{ vx = 0.1 }}`
3. Ctrl-S で保存すると、新しいプログラムがすぐに動きます。
)md";

constexpr std::string_view exercise_system = R"lua(--- A mouse that shall drive.
robot    "mouse"  { model = "raspimouse" }
behavior "driver" { script = "driver" }

connect("driver.wheels", "mouse.target_velocity_in")
)lua";

constexpr std::string_view exercise_behavior = R"lua(--- To do: drive forward.

local wheels = output("wheels", "TimedVelocity2D", "target velocity")

function on_execute()
  wheels:write { vx = 0 }
end
)lua";

constexpr std::string_view shown_scenario = R"lua(scenario("drives forward", function(s)
  local world = s:load "systems/{0}.lua"
  s:eventually("drives", {{ within = 3 }}, function() return world.mouse.truth.pose.position.x > 0.05 end)
end)
)lua";

constexpr std::string_view hidden_scenario = R"lua(scenario("drives straight", function(s)
  local world = s:load "systems/{0}.lua"
  s:run(5)
  s:check(world.mouse.truth.pose.position.x > 0.1, "it has driven")
  s:near(world.mouse.truth.pose.position.y, 0, 0.05, "to the side")
end)
)lua";

}  // namespace

std::vector<NewFile> exercise_files(const std::string& name) {
    return {
        {"text.md", fmt::format(exercise_text, name)},
        {"text.ja.md", fmt::format(exercise_text_ja, name)},
        {fmt::format("start/behaviors/systems/{}.lua", name), std::string(exercise_system)},
        {"start/behaviors/driver.lua", std::string(exercise_behavior)},
        {fmt::format("start/tests/{}_test.lua", name), fmt::format(shown_scenario, name)},
        {"hidden/tests/hidden_test.lua", fmt::format(hidden_scenario, name)},
    };
}

}  // namespace nezumi::cli

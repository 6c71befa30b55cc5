--- A mouse that learns to drive up to a wall and stop before it.
local policy = require "linear_policy"

local NEAR = 0.06 -- where it shall stand: distance of the wall from the mouse's middle, less its radius [m]
local WALL, RADIUS = 0.75, 0.065

local function left(world) return WALL - RADIUS - world.mouse.truth.pose.position.x end

environment {
  system = "learned_stop",
  ticks = 10,
  limit = 80,
  action = { { "forward", min = -1, max = 1 } },
  observation = { { "features", count = policy.SENSORS + 1, min = 0, max = 1 } },

  reset = function(world)
    world.driver:deactivate()
    world.mouse:teleport { x = -0.2 + 0.5 * math.random(), y = 0, heading = 0.2 * (math.random() - 0.5) }
  end,
  act = function(world, action)
    world.mouse.target_velocity_in:hold(policy.velocity(action[1], 0))
  end,
  observe = function(world) return policy.features(world.mouse.ir_sensor_metre_out.value) end,
  reward = function(world) return world.mouse.collided and -20 or -math.abs(left(world) - NEAR) end,
  terminated = function(world) return world.mouse.collided end,
}

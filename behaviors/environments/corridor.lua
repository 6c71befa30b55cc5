--- A mouse that learns to follow a corridor; its width is another one in each episode.
local policy = require "linear_policy"

local NEAR = 0.08 -- [m]

environment {
  system = "learned_corridor",
  ticks = 10,
  limit = 150,
  action = { { "forward", min = -1, max = 1 }, { "turn", min = -1, max = 1 } },
  observation = { { "features", count = policy.SENSORS + 1, min = 0, max = 1 } },

  start = function() return { width = 0.27 + 0.08 * math.random() } end,
  reset = function(world)
    world.driver:deactivate()
    world.mouse:teleport { x = 0, y = 0.02 * (math.random() - 0.5), heading = 0.4 * (math.random() - 0.5) }
  end,
  act = function(world, action)
    world.mouse.target_velocity_in:hold(policy.velocity(action[1], action[2]))
  end,
  observe = function(world) return policy.features(world.mouse.ir_sensor_metre_out.value) end,
  -- The way along the corridor in this step [m], less for a wall that is near.
  reward = function(world)
    if world.mouse.collided then return -2 end
    local v, heading = world.mouse.truth.velocity.vx, world.mouse.truth.pose.heading
    local at = world.mouse.truth.pose.position
    local is_north = at.x > 0.65 and at.y < 0.65
    local nearest = math.min(table.unpack(world.mouse.ir_sensor_metre_out.value))
    return 0.1 * v * (is_north and math.sin(heading) or math.cos(heading)) - math.max(0, NEAR - nearest)
  end,
  terminated = function(world) return world.mouse.collided or world.mouse.truth.pose.position.x > 1.5 end,
}

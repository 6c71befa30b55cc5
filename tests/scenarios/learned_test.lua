--- The mice whose weights were learned: learned_stop, learned_corridor; then what they are made of.

local policy = require "linear_policy"

scenario("a learned mouse stops before the wall from wherever it starts",
  { timeout = 20, sweep = { x = { -0.2, 0, 0.3 } } },
  function(s, p)
    local world = s:load "systems/learned_stop.lua"
    s:teleport(world.mouse, { x = p.x, y = 0, heading = 0 })
    s:never("touches the wall", function() return world.mouse.collided end)
    s:maintain("stands near it", { within = 10, hold = 2 }, function()
      return world.mouse.truth.pose.position.x > 0.585 and math.abs(world.mouse.truth.velocity.vx) < 0.02
    end)
  end)

scenario("a learned mouse follows the corridor around both corners", { timeout = 20 }, function(s)
  local world = s:load "systems/learned_corridor.lua"
  s:never("touches a wall", function() return world.mouse.collided end)
  s:eventually("comes through", { within = 10 }, function() return world.mouse.truth.pose.position.x > 1.4 end)
end)

scenario("a policy sees how near things are, and multiplies that with its weights", function(s)
  s:equal(policy.features { 0.3, 0.15, 0, 0.9 }, { 0, 0.5, 1, 0, 1 })
  s:equal(policy.features {}, { 0, 0, 0, 0, 1 })
  local function act(weights, features) return { policy.act(weights, features) } end
  local weights = { 0.1, 0.2, 0.3, -0.4, 0.5, 0.5, -0.25, 0.125, 0, -0.25 }
  s:equal(act(weights, { 1, 0, 0, 0, 0 }), { 0.1, 0.5 })
  s:equal(act(weights, { 0, 0, 0, 0.5, 1 }), { 0.3, -0.25 })
  s:equal(act({ 1, 1, 0, 0, 0, -1, -1 }, { 1, 1, 0, 0, 0 }), { 1, -1 })
  s:equal(act({ -1, -1, 0, 0, 0, 1, 1 }, { 1, 1, 0, 0, 0 }), { -1, 1 })
  s:equal(act({}, { 1, 1, 1, 1, 1 }), { 0, 0 })
  s:equal(policy.velocity(0.5, -0.5), { vx = 0.15, va = -1.5 })
end)

scenario("a learned mouse drives by its weights, once its sensors have said something", function(s)
  local driver = s:behavior "driver" { script = "learned_driver" }
  s:equal(driver.config.weights, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 })
  s:inject(driver.ranges, { 0.1, 0.1, 0.1 })
  s:run(0.02)
  s:equal(driver.target.age, math.huge)
  driver.config.weights = { 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, -0.25, 0.0, 0.0, 0.0 }
  s:inject(driver.ranges, { 0.3, 0.15, 0.3, 0.3 })
  s:run(0.02)
  s:near(driver.target.value.vx, 0.3 * 0.75, 1e-9)
  s:near(driver.target.value.va, 3 * -0.125, 1e-9)
end)

--- The behaviours that are made of modules, on robots: wall_follower, line_follower, go_to_goal, way_finder,
--- distance_estimator.

scenario("a PID controller leads the mouse along the wall", { timeout = 120, sweep = { speed = { 0.1, 0.15, 0.2 } } },
  function(s, p)
    local world = s:load "systems/wall_follower.lua"
    world.follower.config.speed = p.speed

    s:never("touches anything", function() return world.mouse.collided end)
    s:wait_until("along the north", { within = 20 }, function() return world.mouse.truth.pose.position.x > 0.4 end)
    s:wait_until("down the east", { within = 20 }, function() return world.mouse.truth.pose.position.y < -0.2 end)
    s:wait_until("along the south", { within = 30 }, function() return world.mouse.truth.pose.position.x < -0.4 end)
    s:wait_until("round the box", { within = 40 }, function()
      return world.mouse.truth.pose.position.y > 0.4 and world.mouse.truth.pose.position.x > -0.4
    end)
    s:run(1)
    s:maintain("its distance", { hold = 1, within = 1 }, function()
      return math.abs(world.mouse.ir_sensor_metre_out.value[3] - 0.12) < 0.02
    end)
  end)

scenario("the wall follower turns away at its rate from what is ahead", { timeout = 5 }, function(s)
  local follower = s:behavior "follower" { script = "wall_follower" }
  local config = follower.config
  s:equal({ config.speed, config.distance, config.turn_at, config.kp, config.kd }, { 0.15, 0.12, 0.12, 12.0, 1.5 })
  s:inject(follower.ranges, { 0.2, 0.3, 0.12, 0.2 })
  s:run(0.05)
  s:equal(follower.target.value, { vx = 0.15, vy = 0, va = 0 })
  for _, ahead in ipairs { { 0.11, 0.3, 0.12, 0.2 }, { 0.2, 0.3, 0.12, 0.11 } } do
    s:inject(follower.ranges, ahead)
    s:run(0.05)
    s:equal(follower.target.value, { vx = 0, vy = 0, va = -2.0 })
  end
  s:inject(follower.ranges, { 0.5, 0.3, 0.2, 0.5 })
  s:run(1)
  s:near(follower.target.value.va, 0.15 / 0.25, 1e-9, "round the end of a wall")
  s:inject(follower.ranges, { 0.5, 0.3, 0.1, 0.5 })
  s:run(1)
  s:near(follower.target.value.va, -12 * 0.02, 0.01, "nearer than asked: to the right")
end)

scenario("a behaviour shows its inside by probes", { timeout = 10 }, function(s)
  local world = s:load "systems/wall_follower.lua"
  s:run(2)
  local seen = world.follower.probes.error
  s:near(seen.value, 0.12 - world.follower.ranges.value[3], 0.02)
  s:check(seen.age <= 0.02 and seen.tm > 1.9, seen.age)
  s:check(world.follower.probes.nothing == nil)
  s:check(s:reload("follower", { file = "wall_follower" }))
  s:check(world.follower.probes.error == nil, "a reload empties them")
  s:run(0.1)
  s:check(world.follower.probes.error.tm > 2)
end)

scenario("a reload in the middle keeps what filters and controllers remember", { timeout = 60 }, function(s)
  local world = s:load "systems/wall_follower.lua"
  s:run(2)
  local before = #world.follower.state.side.values
  s:check(before == 3)
  local ok, message = s:reload("follower", { file = "wall_follower" })
  s:check(ok, message)
  s:check(#world.follower.state.side.values == 3 and world.follower.state.keep.measured)
  s:never("touches anything", function() return world.mouse.collided end)
  s:run(5)
end)

scenario("the mouse drives to the given point", { timeout = 60, sweep = { x = { 0.5, -0.4 }, y = { 0.3, -0.2 } } }, function(s, p)
  local world = s:load "systems/go_to_goal.lua"
  s:run(0.1)
  s:check(world.driver.state.mode.current == "rest")
  world.driver:go(p.x, p.y, 2.5)
  s:run(0.05)
  s:check(world.driver.state.mode.current == "face")
  s:wait_until("drives", { within = 5 }, function() return world.driver.state.mode.current == "drive" end)
  s:eventually("is there", { within = 30 }, function() return world.driver.state.mode.current == "rest" end)
  s:run(0.5)
  s:near(world.mouse.truth.pose.position.x, p.x, 0.02)
  s:near(world.mouse.truth.pose.position.y, p.y, 0.02)
  s:near(world.mouse.truth.pose.heading, 2.5, 0.03)
end)

scenario("the mouse keeps its limits on the way, and stands when it is there", { timeout = 40 }, function(s)
  local world = s:load "systems/go_to_goal.lua"
  local driver = world.driver
  s:equal({ driver.config.speed, driver.config.near }, { 0.2, 0.01 })
  s:run(0.1)
  s:equal(driver.state.goal, { x = 0, y = 0, heading = 0 })
  s:never("drives faster than asked", function() return driver.target.value.vx > 0.2 end)
  s:never("turns faster than it may", function() return math.abs(driver.target.value.va) > 3 end)
  -- Behind it and to the right: a heading that jumps from -pi to pi on the way.
  driver:go(-0.5, -0.01)
  s:run(0.05)
  s:equal(driver.state.goal, { x = -0.5, y = -0.01, heading = 0 })
  s:near(driver.target.value.va, -3, 1e-6)
  s:eventually("drives at full speed", { within = 3 }, function() return driver.target.value.vx > 0.199 end)
  s:eventually("slows down", { within = 4 }, function()
    return driver.state.mode.current == "drive" and driver.target.value.vx < 0.1
  end)
  local left = world.mouse.truth.pose.position.x + 0.5
  s:near(driver.target.value.vx, 2 * left, 0.01)
  s:eventually("is there", { within = 10 }, function() return driver.state.mode.current == "rest" end)
  s:run(0.1)
  s:equal(driver.target.value, { vx = 0, vy = 0, va = 0 })
  s:near(world.mouse.truth.pose.heading, 0, 0.03)
end)

scenario("a reload on the way goes on with the goal and the state", { timeout = 60 }, function(s)
  local world = s:load "systems/go_to_goal.lua"
  s:run(0.1)
  world.driver:go(0.4, 0.0, 0)
  s:wait_until("drives", { within = 5 }, function() return world.driver.state.mode.current == "drive" end)
  local ok, message = s:reload("driver", { file = "go_to_goal" })
  s:check(ok, message)
  s:run(0.05)
  s:check(world.driver.state.mode.current == "drive" and world.driver.version == 2)
  s:eventually("is there", { within = 10 }, function() return world.driver.state.mode.current == "rest" end)
  s:near(world.mouse.truth.pose.position.x, 0.4, 0.02)
end)

scenario("the mouse finds its way round walls that it has to see first", { timeout = 90 }, function(s)
  local world = s:load "systems/way_finder.lua"
  s:never("touches anything", function() return world.mouse.collided end)
  s:run(0.1)
  s:check(#world.finder.plan.value == 4, "straight ahead, as nothing is known")
  s:wait_until("has seen the wall", { within = 20 }, function() return #world.finder.plan.value > 4 end)
  s:eventually("is there", { within = 80 }, function()
    local at = world.mouse.truth.pose.position
    return math.abs(at.x - 1.2) < 0.05 and math.abs(at.y) < 0.05
  end)
end)

--- How far a place is from the middle of the line [m]: a rectangle of 1.1 by 0.7 m with corners of radius 0.25 m.
local function from_line(x, y)
  local dx, dy = math.abs(x) - 0.30, math.abs(y) - 0.10
  local outside = math.sqrt(math.max(dx, 0) ^ 2 + math.max(dy, 0) ^ 2)
  return math.abs(outside + math.min(math.max(dx, dy), 0) - 0.25)
end

scenario("the EV3 follows a line once round", { timeout = 90, sweep = { speed = { 0.1, 0.2, 0.25 } } }, function(s, p)
  local world = s:load "systems/line_follower.lua"
  world.follower.config.speed = p.speed
  s:run(1)
  s:always("its sensor stays over the line's edge", function()
    local pose = world.ev3.truth.pose
    return from_line(pose.position.x + 0.06 * math.cos(pose.heading), pose.position.y + 0.06 * math.sin(pose.heading)) < 0.03
  end)
  s:wait_until("east", { within = 15 }, function() return world.ev3.truth.pose.position.x > 0.5 end)
  s:wait_until("north", { within = 15 }, function() return world.ev3.truth.pose.position.y > 0.3 end)
  s:wait_until("west", { within = 20 }, function() return world.ev3.truth.pose.position.x < -0.5 end)
  s:wait_until("round", { within = 20 }, function()
    return world.ev3.truth.pose.position.y < -0.3 and world.ev3.truth.pose.position.x > 0
  end)
end)

scenario("the line follower steers by the light, within limits, and waits for it", { timeout = 5 }, function(s)
  local follower = s:behavior "follower" { script = "line_follower" }
  local config = follower.config
  s:equal({ config.speed, config.edge, config.kp, config.kd }, { 0.15, 50.0, 0.03, 0.001 })
  s:run(0.1)
  s:equal(follower.target.value, { vx = 0, vy = 0, va = 0 }, "no light yet")
  s:inject(follower.light, 40)
  s:run(0.05)
  s:near(follower.target.value.vx, 0.15, 1e-9)
  s:near(follower.target.value.va, 0.3, 1e-6, "too dark: to the left")
  s:inject(follower.light, 41)
  s:run(0.02)
  s:check(follower.target.value.va < 0.26, "the derivative acts at once")
  config.kp = 1.0
  s:inject(follower.light, 0)
  s:run(0.5)
  s:near(follower.target.value.va, 2, 1e-9)
  s:inject(follower.light, 100)
  s:run(0.5)
  s:near(follower.target.value.va, -2, 1e-9)
  local measured = follower.state.keep.measured
  s:check(s:reload("follower", { file = "line_follower" }))
  s:equal(follower.state.keep.measured, measured, "a reload keeps what the controller remembers")
end)

scenario("a Kalman filter tells the mouse's speed from its distance to the wall", { timeout = 30 }, function(s)
  s:arena { s:box { at = { 0.65, 0.0 }, size = { 0.1, 1.0, 0.3 } } }
  s:robot "mouse" { model = "raspimouse" }
  s:behavior "estimator" { script = "distance_estimator" }
  local estimator = s.estimator
  s:connect("mouse.ir_sensor_metre_out", "estimator.seen")
  s:hold("mouse.target_velocity_in", { vx = 0.1 })
  s:run(2)
  s:near(estimator.estimate.value[1], s.mouse.ir_sensor_metre_out.value[1], 0.005)
  s:near(estimator.estimate.value[2], -0.1, 0.005)
  local ok, message = s:reload("estimator", { file = "distance_estimator" })
  s:check(ok, message)
  s:check(#estimator.state.p == 2 and #estimator.state.p[1] == 2, "state shows the rows")
  s:always("the estimate goes on", function() return math.abs(estimator.estimate.value[2] + 0.1) < 0.01 end)
  s:run(0.5)
end)

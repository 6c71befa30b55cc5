--- SampleTouchSensor by itself, every branch; then the system in which the EV3's touch sensors drive the mouse.

local function driver_alone(s, config)
  s:behavior("driver", { script = "sample_touch_sensor", config = config })
  local driver = s.driver
  local function touch(...)
    s:inject("driver.touch", { ... })
    s:run(0.02)
    return driver.target_velocity.value
  end
  return driver, touch
end

scenario("right drives forward, left backward, neither stops", function(s)
  local _, touch = driver_alone(s)
  s:near(touch(true, false).vx, 0.2, 0)
  s:near(touch(false, true).vx, -0.2, 0)
  s:near(touch(false, false).vx, 0, 0)
  s:near(touch(true, true).vx, 0.2, 0, "the right one comes first")
  s:near(touch(true, true).va, 0, 0)
end)

scenario("its speed is the configured one", { sweep = { speed = { 0.05, 0.2, -0.1 } } }, function(s, p)
  local _, touch = driver_alone(s, { speed = p.speed })
  s:near(touch(true, false).vx, p.speed, 0)
  s:near(touch(false, true).vx, -p.speed, 0)
end)

scenario("acts only on new data", function(s)
  local driver, touch = driver_alone(s)
  s:run(0.5)
  s:check(driver.target_velocity.age == math.huge, "silent before the first message")
  touch(true, false)
  s:run(0.5)
  s:check(driver.target_velocity.age > 0.45, "one message, one command")
end)

scenario("a sequence of any length but 2 is passed over", { sweep = { length = { 0, 1, 3, 8 } } }, function(s, p)
  local driver, touch = driver_alone(s)
  touch(true, false)
  local values = {}
  for i = 1, p.length do values[i] = false end
  touch(table.unpack(values))
  s:near(driver.target_velocity.value.vx, 0.2, 0)
  s:check(driver.target_velocity.age > 0.015, "nothing was written")
  s:check(driver.status == "ACTIVE")
  s:near(touch(false, true).vx, -0.2, 0, "and goes on with the next of 2")
end)

scenario("the EV3's touch sensors drive the mouse", { timeout = 30 }, function(s)
  local world = s:load "systems/touch_drive.lua"
  local mouse = world.mouse
  s:run(0.5)
  s:near(mouse.truth.velocity.vx, 0, 0.001)
  s:press("ev3", "right", 1.5)
  s:eventually("forward", { within = 1 }, function() return mouse.truth.velocity.vx > 0.19 end)
  s:eventually("stops when it is let go", { within = 3 }, function() return math.abs(mouse.truth.velocity.vx) < 0.001 end)
  s:press("ev3", "left", 1.5)
  s:eventually("backward", { within = 1 }, function() return mouse.truth.velocity.vx < -0.19 end)
  s:eventually("stops again", { within = 3 }, function() return math.abs(mouse.truth.velocity.vx) < 0.001 end)
end)

scenario("a mouse whose touch sensors fall silent stops", { timeout = 30 }, function(s)
  local world = s:load "systems/touch_drive.lua"
  s:press("ev3", "right")
  s:wait_until("under way", { within = 2 }, function() return world.mouse.truth.velocity.vx > 0.19 end)
  s:drop("ev3.touch")
  s:eventually("stops by itself", { within = 1 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end)
end)

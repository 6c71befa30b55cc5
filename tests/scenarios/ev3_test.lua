--- The EV3: wheels that a hand rolls, sensors, screen; and the mouse that it leads.

local function alone(s, pose)
  s:robot("ev3", { model = "ev3", pose = pose or { x = 0, y = 0, heading = 0 } })
  return s.ev3
end

scenario("a hand rolls the EV3 until its first command, then it holds", { timeout = 30 }, function(s)
  local ev3 = alone(s)
  s:disturb("ev3", { vx = 0.2, va = 0.3, seconds = 1 })
  s:run(0.5)
  s:near(ev3.current_vel.value.vx, 0.2, 0.01)
  s:near(ev3.current_vel.value.va, 0.3, 0.015)
  s:run(2)
  s:inject("ev3.velocity2D", { vx = 0, va = 0 })
  s:run(0.1)
  s:disturb("ev3", { vx = 0.2, seconds = 1 })
  s:run(0.5)
  s:near(ev3.current_vel.value.vx, 0, 0.001, "the motors hold")
  s:restore "ev3"
  s:run(0.1)
  ev3:deactivate()
  ev3:activate()
  s:disturb("ev3", { vx = 0.1, seconds = 1 })
  s:run(0.5)
  s:near(ev3.current_vel.value.vx, 0.1, 0.005, "after another activation it coasts again")
end)

scenario("a command that times out holds the EV3", { timeout = 30 }, function(s)
  local ev3 = alone(s)
  s:inject("ev3.velocity2D", { vx = 0.2 })
  s:run(2)
  s:near(ev3.truth.velocity.vx, 0, 0.001)
  s:disturb("ev3", { vx = 0.2, seconds = 1 })
  s:run(0.5)
  s:near(ev3.current_vel.value.vx, 0, 0.001)
end)

scenario("the EV3 drives as told, and its odometry follows", { timeout = 30 }, function(s)
  local ev3 = alone(s)
  s:hold("ev3.velocity2D", { vx = 0.2, va = 0.4 })
  s:run(3)
  s:near(ev3.truth.velocity.vx, 0.2, 0.004)
  s:near(ev3.odometry.value.position.x, ev3.truth.pose.position.x, 0.02)
  s:near(ev3.odometry.value.position.y, ev3.truth.pose.position.y, 0.02)
  s:near(ev3.odometry.value.heading, ev3.truth.pose.heading, 0.03)
  s:hold("ev3.velocity2D", { vx = 0, va = 0 })
  s:run(1)
  s:inject("ev3.pos_update", { position = { x = 5, y = -2 }, heading = 1 })
  s:run(0.05)
  s:near(ev3.odometry.value.position.x, 5, 0.001)
  s:near(ev3.odometry.value.heading, 1, 0.001)
end)

scenario("the gyro counts counter-clockwise, and no faster than 440 degrees a second", { timeout = 30 }, function(s)
  local ev3 = alone(s)
  s:hold("ev3.velocity2D", { va = 1 })
  s:run(3)
  s:near(ev3.gyro.value, ev3.truth.pose.heading, math.rad(3.5))
  s:hold("ev3.velocity2D", { va = 0 })
  s:run(1)
  local before = ev3.gyro.value
  s:hold("ev3.velocity2D", { va = -8.5 })
  s:run(3)
  local rate = (ev3.gyro.value - before) / 3
  s:check(rate < -math.rad(380) and rate > -math.rad(445), "limited: " .. math.deg(rate))
end)

scenario("a gyro at rest drifts", { timeout = 200 }, function(s)
  local ev3 = alone(s)
  s:run(100)
  s:near(ev3.gyro.value, math.rad(2), math.rad(3))
  local sum = 0
  for _ = 1, 100 do
    s:run(0.01)
    sum = sum + ev3.gyro.value
  end
  s:check(sum / 100 > math.rad(1), "by about 0.02 degrees a second")
end)

scenario("the ultrasonic sensor stays between 0.03 and 2.5 m, within 0.01 m of the truth",
  { sweep = { gap = { 0.02, 0.3, 1.0, 2.3, 3.0 } } }, function(s, p)
    s:arena { s:box { at = { 0.07 + p.gap + 0.05, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }
    local ev3 = alone(s)
    local expected = math.max(0.03, math.min(2.5, p.gap))
    s:run(0.1)
    s:always("one range near the truth", function()
      return #ev3.ultrasonic.value.ranges == 1 and math.abs(ev3.ultrasonic.value.ranges[1] - expected) <= 0.0101
    end)
    s:always("within its limits", function()
      return ev3.ultrasonic.value.ranges[1] >= 0.03 and ev3.ultrasonic.value.ranges[1] <= 2.5
    end)
    s:run(2)
    s:near(ev3.ultrasonic.value.config.minRange, 0.03, 0)
    s:near(ev3.ultrasonic.value.config.maxRange, 2.5, 0)
  end)

scenario("the medium motor turns the ultrasonic sensor, in its time", { timeout = 30 }, function(s)
  s:arena { s:box { at = { 0.07, 0.55, 0.15 }, size = { 0.2, 0.1, 0.3 } } }
  local ev3 = alone(s)
  s:run(0.1)
  s:near(ev3.ultrasonic.value.ranges[1], 2.5, 0)
  s:inject("ev3.angle", math.pi / 2)
  s:run(0.5)
  s:near(ev3.ultrasonic.value.geometry.pose.orientation.y, 0.8, 0.04, "1.6 rad/s")
  s:near(ev3.ultrasonic.value.ranges[1], 2.5, 0, "on its way")
  s:run(0.6)
  s:near(ev3.ultrasonic.value.ranges[1], 0.5, 0.011)
  s:run(1)
  s:near(ev3.ultrasonic.value.ranges[1], 0.5, 0.011, "silence holds the angle")
  ev3.config.medium_motor_speed = 10
  s:inject("ev3.angle", 0)
  s:run(0.19)
  s:near(ev3.ultrasonic.value.geometry.pose.orientation.y, 0, 1e-9, "faster, if asked to")
end)

scenario("a gyro measures its rate, and a light sensor distinguishes a dark room from a lit one", { timeout = 30 }, function(s)
  local ev3 = alone(s)
  s:disturb("ev3", { va = 0.5 })
  s:run(1)
  s:near(ev3.gyro_rate.value, 0.5, 0.02)
  s:near(ev3.light_ambient.value, 10, 2)
end)

scenario("the EV3 sees colours and light of the floor, and none outside of it", { timeout = 30 }, function(s)
  s:arena { s:floor { image = "stripes.png", size = { 1.6, 0.4 } } }
  local ev3 = alone(s, { x = -0.7, y = 0, heading = 0 })
  local names = { "black", "blue", "green", "yellow", "red", "white", "brown", "white" }
  for i, name in ipairs(names) do
    s:teleport("ev3", { x = -0.7 + 0.2 * (i - 1) - 0.06, y = 0, heading = 0 })
    s:run(0.05)
    s:check(ev3.color.value == name, ("stripe %d: %s, not %s"):format(i, ev3.color.value, name))
    if i == 1 then s:near(ev3.light_reflect.value, 0, 2) end
    if i == 6 then s:near(ev3.light_reflect.value, 100, 2) end
    if i == 8 then s:near(ev3.light_reflect.value, 50, 2) end
  end
  s:teleport("ev3", { x = 3, y = 0, heading = 0 })
  s:run(0.05)
  s:check(ev3.color.value == "none")
  s:near(ev3.light_reflect.value, 0, 2)
end)

scenario("driving against a wall closes both touch sensors", { timeout = 30 }, function(s)
  s:arena { s:box { at = { 0.4, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }
  local ev3 = alone(s)
  s:hold("ev3.velocity2D", { vx = 0.1 })
  s:run(1)
  s:check(not ev3.touch.value[1] and not ev3.touch.value[2], "open on the way")
  s:eventually("both close", { within = 5 }, function() return ev3.touch.value[1] and ev3.touch.value[2] end)
  s:hold("ev3.velocity2D", { vx = -0.1 })
  s:eventually("both open", { within = 2 }, function() return not ev3.touch.value[1] and not ev3.touch.value[2] end)
  s:press("ev3", "left", 0.5)
  s:run(0.1)
  s:check(ev3.touch.value[2] and not ev3.touch.value[1], "[0] is the right one, [1] the left one")
end)

scenario("a torn picture for the screen costs nothing but itself", function(s)
  local ev3 = alone(s)
  s:inject("ev3.lcd", { width = 178, height = 128, bpp = 8, format = "gray8", pixels = ("\0"):rep(100) })
  s:run(0.05)
  s:inject("ev3.lcd", { width = 2, height = 2, bpp = 8, format = "gray8", pixels = "\0\255\0\255" })
  s:run(0.05)
  s:check(ev3.status == "ACTIVE")
  s:near(ev3.lcd.value.width, 2, 0)
end)

scenario("the mouse follows the EV3 that a hand rolls",
  { timeout = 30, sweep = { vx = { 0.1, 0.3, -0.2 }, va = { 0.0, 0.5 } } }, function(s, p)
    local world = s:load "systems/leader_follower.lua"
    s:run(0.2)
    s:disturb("ev3", { vx = p.vx, va = p.va })
    s:run(0.5)
    local mouse, ev3 = world.mouse.truth, world.ev3.truth
    s:maintain("the same speed and turn within 5 %", { hold = 1.5, within = 0.01 }, function()
      return math.abs(mouse.velocity.vx - ev3.velocity.vx) <= 0.05 * math.abs(p.vx)
        and math.abs(mouse.velocity.va - ev3.velocity.va) <= 0.05 * math.abs(p.va) + 0.002
    end)
    s:near(ev3.velocity.vx, p.vx, 0.01)
    s:restore "ev3"
    s:disturb("ev3", { vx = 0, va = 0 })
    s:eventually("both rest", { within = 2 }, function() return math.abs(mouse.velocity.vx) < 0.002 end)
  end)

scenario("the mouse goes as far as the EV3 that a hand rolls, and turns as much", { timeout = 30 }, function(s)
  local world = s:load "systems/leader_follower.lua"
  local mouse, ev3 = world.mouse.truth, world.ev3.truth
  s:run(0.3)
  s:disturb("ev3", { vx = 0.1, va = 0.3 })
  s:run(2)
  s:disturb("ev3", { vx = 0, va = 0 })
  s:eventually("both rest", { within = 2 }, function()
    return math.abs(mouse.velocity.vx) < 0.002 and math.abs(ev3.velocity.vx) < 0.002
  end)
  local rolled, came = ev3.pose.position, mouse.pose.position
  s:near(math.sqrt(came.x ^ 2 + came.y ^ 2), math.sqrt(rolled.x ^ 2 + (rolled.y - 0.4) ^ 2), 0.02)
  s:near(mouse.pose.heading, ev3.pose.heading, 0.1)
end)

--- The engine's promises: whatever happens to a behaviour or a connection, the robot stops; no fault outlives its time.

--- A mouse that is driven forward by a behaviour that can be made to fail.
local function driven_mouse(s)
  s:robot "mouse" { model = "raspimouse" }
  s:behavior "driver" { script = "fails_on_demand" }
  s:connect("driver.out", "mouse.target_velocity_in")
  s:wait_until("it drives", { within = 1 }, function() return s.mouse.truth.velocity.vx > 0.19 end)
  return s.mouse, s.driver
end

--- Stands still from now on, at the latest after so many seconds.
local function expect_stop(s, mouse, seconds)
  s:eventually("stops", { within = seconds }, function() return math.abs(mouse.truth.velocity.vx) < 0.001 end)
  s:maintain("stays", { hold = 1, within = 0 }, function() return math.abs(mouse.truth.velocity.vx) < 0.001 end)
end

scenario("an error in a behaviour stops its robot", function(s)
  local mouse, driver = driven_mouse(s)
  s:allow_error(driver)
  driver.config.fail = true
  s:run(0.01)
  s:check(driver.status == "ERROR", driver.status)
  s:near(driver.out.value.vx, 0, 0)
  expect_stop(s, mouse, 0.3)
end)

scenario("deactivation stops the robot, activation lets it go on", function(s)
  local mouse, driver = driven_mouse(s)
  driver:deactivate()
  expect_stop(s, mouse, 0.3)
  driver:activate()
  s:eventually("drives", { within = 1 }, function() return mouse.truth.velocity.vx > 0.19 end)
end)

scenario("a robot that hears nothing for half a second stops", function(s)
  local mouse = driven_mouse(s)
  s:drop("driver.out")
  s:run(0.4)
  s:near(mouse.truth.velocity.vx, 0.2, 0.01)
  expect_stop(s, mouse, 0.4)
  s:restore "driver.out"
  s:eventually("drives", { within = 1 }, function() return mouse.truth.velocity.vx > 0.19 end)
end)

scenario("a dropped port comes back when its time is over", function(s)
  local mouse = driven_mouse(s)
  s:drop(mouse.target_velocity_in, 2)
  s:run(1.9)
  s:near(mouse.truth.velocity.vx, 0, 0.001)
  s:eventually("drives again", { within = 0.5 }, function() return mouse.truth.velocity.vx > 0.19 end)
end)

scenario("a frozen sensor keeps its value, and lets go of it", function(s)
  local world = s:load "systems/stop_at_wall.lua"
  s:run(0.5)
  s:freeze(world.mouse.ir_sensor_out, 2.5)
  local function seen() return world.mouse.ir_sensor_out.value[1] or 0 end
  s:always("sees nothing", function() return s:now() > 3.005 or seen() == 0 end)
  s:run(2.5)
  s:eventually("sees the wall", { within = 0.1 }, function() return seen() > 0 end)
end)

scenario("commands are held within the robot's limits", function(s)
  local mouse, driver = driven_mouse(s)
  driver.config.speed = 5.0
  s:always("keeps to its limit", function() return mouse.truth.velocity.vx < 0.51 end)
  s:eventually("reaches its limit", { within = 1 }, function() return mouse.truth.velocity.vx > 0.49 end)
end)

scenario("a hand pushes the robot and lets go", function(s)
  s:robot "mouse" { model = "raspimouse" }
  s:disturb(s.mouse, { vx = 0.3, seconds = 1 })
  s:run(0.5)
  s:near(s.mouse.truth.velocity.vx, 0.3, 0.02)
  s:run(0.5)
  s:eventually("rests", { within = 0.5 }, function() return math.abs(s.mouse.truth.velocity.vx) < 0.001 end)
end)

scenario("a pressed button is released in time, or when it is restored", function(s)
  s:robot "mouse" { model = "raspimouse" }
  local function pressed() return s.mouse.switch3bit_out.value[2] end
  s:press(s.mouse, "switch1", 0.5)
  s:eventually("is pressed", { within = 0.1 }, pressed)
  s:eventually("is released", { within = 0.6 }, function() return not pressed() end)
  s:press("mouse", "switch1")
  s:run(5)
  s:check(pressed(), "it stays pressed")
  s:restore(s.mouse)
  s:eventually("is released again", { within = 0.1 }, function() return not pressed() end)
end)

scenario("a broken version is refused while the robot drives on", function(s)
  local world = s:load "systems/stop_at_wall.lua"
  s:run(1)
  s:always("drives on", function() return world.controller.status == "ACTIVE" and world.controller.out.value.vx == 0.1 end)
  local ok, message = s:reload("controller", { text = "function on_execute( end" })
  s:check(not ok and world.controller.version == 1, message)
  s:check(message:find("still running version 1", 1, true), message)
  s:run(1)
end)

scenario("a new version runs from the next tick", function(s)
  local world = s:load "systems/stop_at_wall.lua"
  s:run(1)
  local ok, message = s:reload(world.controller, { text = [[
    local out = output("out", "TimedVelocity2D")
    input("in", "TimedShortSeq")
    function on_execute() out:write { vx = -0.05 } end
  ]] })
  s:check(ok, message)
  s:run(0.01)
  s:near(world.controller.out.value.vx, -0.05, 0)
  s:check(world.controller.version == 2)
end)

scenario("an emergency stop lasts until it is rearmed", function(s)
  local mouse, driver = driven_mouse(s)
  s:stop()
  expect_stop(s, mouse, 0.3)
  s:check(driver.status == "ACTIVE", "behaviours go on")
  s:check(mouse.target_velocity_in.note == "emergency stop: commands are ignored until rearm()", mouse.target_velocity_in.note)
  s:rearm()
  s:eventually("drives", { within = 1 }, function() return mouse.truth.velocity.vx > 0.19 end)
  s:stop()
  local ok, message = pcall(s.rearm, s)
  s:check(not ok and message:find "mouse still moves, at 0.1", message)
end)

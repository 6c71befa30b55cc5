--- The rover's driver, tried against the model of its microcontroller: the whole way from a command to the wheels.

scenario("the rover drives to its goal through its driver and its microcontroller", { timeout = 20 }, function(s)
  local world = s:load "systems/rover.lua"
  s:run(0.2)
  world.pilot:go(0.4, 0.2, math.pi / 2)
  s:eventually("is there", { within = 15 }, function()
    local p = world.rover.truth.pose
    return math.abs(p.position.x - 0.4) < 0.03 and math.abs(p.position.y - 0.2) < 0.03
  end)
  s:run(1)
  s:near(world.rover.current_pose_out.value.position.x, world.rover.truth.pose.position.x, 0.01)
end)

scenario("a driver is not reloaded while its rover moves", { timeout = 10 }, function(s)
  local world = s:load "systems/rover.lua"
  s:run(0.2)
  world.pilot:go(2, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return world.rover.truth.velocity.vx > 0.1 end)
  local ok, message = s:reload("rover_driver", { file = "rover_driver" })
  s:check(not ok and message:find("rover_driver drives 'rover', which moves: reload it when the robot stands still", 1, true), message)
  world.pilot:deactivate()
  s:eventually("stands", { within = 2 }, function() return math.abs(world.rover.truth.velocity.vx) < 0.001 end)
  s:run(0.2)
  s:check(s:reload("rover_driver", { file = "rover_driver" }))
end)

scenario("a driver that is deactivated leaves the safe bytes to its microcontroller", { timeout = 10 }, function(s)
  local world = s:load "systems/rover.lua"
  s:run(0.2)
  world.pilot:go(2, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return world.rover.truth.velocity.vx > 0.1 end)
  world.rover_driver:deactivate()
  s:run(0.03)
  s:equal(world.rover_line.wire_out.value, "v 0 0")
  s:eventually("stands", { within = 0.5 }, function() return math.abs(world.rover.truth.velocity.vx) < 0.001 end)
end)

scenario("a low battery brakes the rover", { timeout = 10 }, function(s)
  local world = s:load "systems/rover.lua"
  s:run(0.2)
  world.pilot:go(2, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return world.rover.truth.velocity.vx > 0.1 end)
  world.rover_model.config.volts = 6.0
  s:eventually("stands", { within = 1 }, function() return math.abs(world.rover.truth.velocity.vx) < 0.001 end)
  world.rover_model.config.volts = 7.4
  s:eventually("drives again", { within = 1 }, function() return world.rover.truth.velocity.vx > 0.1 end)
end)

scenario("a line that is cut stops the rover by the time-out of its microcontroller", { timeout = 10 }, function(s)
  local world = s:load "systems/rover.lua"
  s:run(0.2)
  world.pilot:go(2, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return world.rover.truth.velocity.vx > 0.1 end)
  s:drop("rover_line.wire_out")
  s:eventually("stands", { within = 0.6 }, function() return math.abs(world.rover.truth.velocity.vx) < 0.001 end)
end)

scenario("an emergency stop brakes the rover through its driver, and then only the safe bytes reach it", { timeout = 10 }, function(s)
  local world = s:load "systems/rover.lua"
  s:run(0.2)
  world.pilot:go(2, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return world.rover.truth.velocity.vx > 0.15 end)
  s:stop()
  s:run(0.05)
  local speed = tonumber(world.rover_line.wire_out.value:match("^v (%S+) "))
  s:check(speed > 0 and speed < 0.2, speed) -- it brakes within its limits
  s:run(1)
  s:equal(world.rover_line.wire_out.value, "v 0 0")
  s:check(world.rover_line.wire_out.age > 0.3, "nothing follows the safe bytes")
  s:check(math.abs(world.rover.truth.velocity.vx) < 0.001)
end)

scenario("the rover's driver reads the lines of its microcontroller, and no torn ones", { timeout = 5 }, function(s)
  local driver = s:behavior "driver" { script = "rover_driver" }
  s:equal({ driver.config.low_voltage, driver.config.warning_voltage }, { 6.4, 6.8 })
  local function take(...)
    for _, line in ipairs { ... } do s:inject(driver.line_in, line) end
    s:run(0.02)
  end
  s:equal(driver.state.warned, false)
  take("e 120 -118", "r 0.53", "b 7.4")
  s:equal({ driver.wheel_pulses.value, driver.distance.value, driver.may_drive.value }, { { 120, -118 }, 0.53, true })
  s:near(driver.probes.battery.value, 7.4, 1e-9)
  take("e 7 8\r")
  s:equal(driver.wheel_pulses.value, { 7, 8 })
  take("e 12", "e 1 2 3", "r 1", "r 0.", "b 5", "x 1.5", " r 1.5", "")
  s:equal({ driver.wheel_pulses.value, driver.distance.value, driver.may_drive.value }, { { 7, 8 }, 0.53, true })
  local function volts(value, may_drive, warned)
    take(("b %.2f"):format(value))
    s:equal({ driver.may_drive.value, driver.state.warned }, { may_drive, warned })
  end
  volts(6.8, true, false)
  volts(6.79, true, true)
  volts(6.4, true, true)
  volts(6.39, false, true)
  volts(7.0, true, false)
  volts(6.7, true, true)
  s:check(s:reload("driver", { file = "rover_driver" }))
  s:equal(driver.state.warned, true, "a reload does not warn again")
end)

scenario("the rover's driver sends its speeds as a line in each execution", { timeout = 5 }, function(s)
  local driver = s:behavior "driver" { script = "rover_driver" }
  s:run(0.02)
  s:equal(driver.line_out.value, "v 0.000 0.000")
  s:inject(driver.target_velocity_in, { vx = -0.1234, va = 0.5 })
  s:run(0.02)
  s:equal(driver.line_out.value, "v -0.123 0.500")
  s:run(1)
  s:check(driver.line_out.age < 0.02)
end)

scenario("the rover's microcontroller does what a line says, and stops without lines", { timeout = 5 }, function(s)
  local model, kept = s:behavior "model" { script = "rover_firmware" }, s:behavior "kept" { script = "keeps_all" }
  s:connect("model.line_out", "kept.texts")
  s:equal(model.config.volts, 7.4)
  local function drives(vx, va) s:equal(model.target_velocity_in.value, { vx = vx, vy = 0, va = va }) end
  local function take(line)
    s:inject(model.line_in, line)
    s:run(0.02)
  end
  s:run(0.02)
  drives(0, 0)
  s:equal(kept.state.texts[1], "e 0 0")
  s:equal({ kept.state.texts[2], kept.state.texts[3] }, { "r 0.000", "b 7.40" })
  s:inject(model.wheel_pulses, { 120, -5 })
  s:inject(model.front, 0.53)
  s:run(0.01)
  kept:forget()
  s:run(0.01)
  s:equal(kept.state.texts, { "e 120 -5", "r 0.530", "b 7.40" })
  take "v 0.25 -0.5"
  drives(0.25, -0.5)
  take "v 0.3"
  drives(0.25, -0.5)
  s:run(0.26)
  drives(0.25, -0.5)
  s:run(0.06)
  drives(0, 0)
end)

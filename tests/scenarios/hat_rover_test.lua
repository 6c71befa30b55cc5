--- The hat rover's driver, tried against models of its devices: registers, echoes, and the battery.

local function start(s)
  local world = s:load "systems/hat_rover.lua"
  s:run(0.5)
  return world
end

local function moves(world) return math.abs(world.rover.truth.velocity.vx) > 0.1 end
local function stands(world) return math.abs(world.rover.truth.velocity.vx) < 0.001 end

scenario("the hat rover drives to its goal by the registers of its motor hat", { timeout = 20 }, function(s)
  local world = start(s)
  world.pilot:go(0.4, 0.2, math.pi / 2)
  s:eventually("is there", { within = 15 }, function()
    local p = world.rover.truth.pose
    return math.abs(p.position.x - 0.4) < 0.05 and math.abs(p.position.y - 0.2) < 0.05
  end)
end)

scenario("the hat rover measures the wall ahead by the times of an echo", { timeout = 5 }, function(s)
  local world = start(s)
  s:near(world.rover.distance.value, 1.15 - 0.09, 0.005)
end)

scenario("a low battery warns, and then brakes the hat rover", { timeout = 10 }, function(s)
  local world = start(s)
  world.pilot:go(0.9, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return moves(world) end)
  world.rover_model.config.volts = 6.7
  s:run(0.5)
  s:check(moves(world), "a warning does not brake")
  s:near(world.rover_driver.probes.battery.value, 6.7, 0.005)
  world.rover_model.config.volts = 6.0
  s:eventually("stands", { within = 1 }, function() return stands(world) end)
end)

scenario("an emergency stop brakes the hat rover, and then switches all outputs of its hat off", { timeout = 10 }, function(s)
  local world = start(s)
  world.pilot:go(0.9, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return moves(world) end)
  s:stop()
  s:run(1)
  s:check(stands(world))
  s:equal(world.rover_hat.wire_out.value, "\xFD\x10")
  s:check(world.rover_hat.wire_out.age > 0.3, "nothing follows the safe bytes")
end)

scenario("a hat that lost its power for a moment is woken, and the rover drives on", { timeout = 10 }, function(s)
  local world = start(s)
  world.pilot:go(0.9, 0, 0)
  s:wait_until("under way", { within = 5 }, function() return moves(world) end)
  world.rover_model:lose_power()
  s:eventually("stands", { within = 0.3 }, function() return stands(world) end)
  s:eventually("drives on", { within = 2 }, function() return moves(world) end)
end)

scenario("the hat rover's driver sets its motors by the registers of their channels", { timeout = 5 }, function(s)
  local driver = s:behavior "driver" { script = "hat_rover_driver" }
  s:equal({ driver.config.full_speed, driver.config.track }, { 0.6, 0.13 })
  local OFF, ON = "\x00\x00\x00\x10", "\x00\x10\x00\x00"
  local function channel(count) return string.pack("<I2I2", 0, count) end
  -- From channel 8 on: power, back, ahead of the left motor, ahead, back, power of the right one.
  local function sets(vx, va, ...)
    s:inject(driver.target_velocity_in, { vx = vx, va = va })
    s:run(0.02)
    s:equal(driver.hat_out.value, "\x26" .. table.concat { ... })
    s:equal(driver.current_velocity_out.value, { vx = vx, vy = 0, va = va })
  end
  sets(0, 0, OFF, OFF, OFF, OFF, OFF, OFF)
  sets(0.3, 0, channel(2048), OFF, ON, ON, OFF, channel(2048))
  sets(-0.3, 0, channel(2048), ON, OFF, OFF, ON, channel(2048))
  sets(0.3, 2, channel(1161), OFF, ON, ON, OFF, channel(2935)) -- 0.17 m/s and 0.43 m/s
  sets(0, 2, channel(887), ON, OFF, ON, OFF, channel(887))
  sets(0.6, 0, ON, OFF, ON, ON, OFF, ON)
  sets(0.9, 0, ON, OFF, ON, ON, OFF, ON)
  sets(0.00007, 0, OFF, OFF, ON, ON, OFF, OFF)
  sets(0.00008, 0, channel(1), OFF, ON, ON, OFF, channel(1))
end)

scenario("the hat rover's driver wakes a hat only if it sleeps", { timeout = 5 }, function(s)
  local driver = s:behavior "driver" { script = "hat_rover_driver" }
  local kept = s:behavior "kept" { script = "keeps_all" }
  s:connect("driver.hat_out", "kept.bytes")
  local stand = "\x26" .. ("\x00\x00\x00\x10"):rep(6)
  s:run(0.05)
  kept:forget()
  s:inject(driver.hat_in, "\x00\x01")
  s:run(0.03)
  s:equal(kept.state.bytes, { stand, stand, stand })
  kept:forget()
  s:inject(driver.hat_in, "\x00\x11")
  s:run(0.03)
  s:equal(kept.state.bytes, { stand, "\x00\x10", "\xFE\x03", "\x00\x20", stand, stand })
end)

scenario("the hat rover's driver reads the voltage of its battery", { timeout = 5 }, function(s)
  local driver = s:behavior "driver" { script = "hat_rover_driver" }
  s:equal({ driver.config.low_voltage, driver.config.warning_voltage }, { 6.4, 6.8 })
  local function volts(value, may_drive, warned)
    s:inject(driver.battery_in, "\x02" .. string.pack(">I2", math.floor(value / 0.004 + 0.5) << 3 | 2))
    s:run(0.02)
    s:near(driver.probes.battery.value, value, 1e-9)
    s:equal({ driver.may_drive.value, driver.state.warned }, { may_drive, warned })
  end
  s:equal(driver.state.warned, false)
  volts(7.4, true, false)
  volts(6.804, true, false)
  volts(6.796, true, true)
  volts(6.404, true, true)
  volts(6.396, false, true)
  volts(6.9, true, false)
  volts(6.7, true, true)
  s:check(s:reload("driver", { file = "hat_rover_driver" }))
  s:equal(driver.state.warned, true, "a reload does not warn again")
end)

scenario("the hat rover's driver measures by a trigger and the two edges of its echo", { timeout = 5 }, function(s)
  local driver = s:behavior "driver" { script = "hat_rover_driver" }
  local kept = s:behavior "kept" { script = "keeps_all" }
  s:connect("driver.sonar_out", "kept.texts")
  s:run(0.19)
  s:equal(kept.state.texts, { "23=1", "23=0", "23=1", "23=0", "23=1", "23=0" }, "every 0.06 s")
  local function echo(first, second)
    if first then s:inject(driver.sonar_in, ("24=1 %.6f"):format(first)) end
    s:inject(driver.sonar_in, ("24=0 %.6f"):format(second))
    s:run(0.02)
    return driver.distance.value
  end
  s:near(echo(1, 1.004), 0.004 * 171.5, 1e-9)
  s:near(echo(2, 2.011), 0.011 * 171.5, 1e-9)
  s:equal(echo(3, 3.012), 2)
  s:near(echo(4, 4.001), 0.001 * 171.5, 1e-9)
  s:run(0.2)
  s:near(echo(nil, 4.005), 0.001 * 171.5, 1e-9)
  s:check(driver.distance.age > 0.2, "an edge without the one before counts for nothing")
end)

scenario("the model of the hat drives the wheels as its registers say", { timeout = 5 }, function(s)
  local devices = s:behavior "devices" { script = "hat_rover_devices" }
  s:equal({ devices.config.full_speed, devices.config.track, devices.config.volts }, { 0.6, 0.13, 7.4 })
  local OFF, ON = "\x00\x00\x00\x10", "\x00\x10\x00\x00"
  local function sets(bytes, vx, va)
    s:inject(devices.hat_in, bytes)
    s:run(0.02)
    s:near(devices.target_velocity_in.value.vx, vx, 1e-6)
    s:near(devices.target_velocity_in.value.va, va, 1e-6)
  end
  local function channel(count) return string.pack("<I2I2", 0, count) end
  -- 0.3 m/s less a bit, and half of that.
  local left, right = 0.6 * 2047 / 4096, 0.6 * 1023 / 4096
  local ahead = "\x26" .. channel(2047) .. OFF .. ON .. ON .. OFF .. channel(1023)
  local function sets_ahead(bytes) sets(bytes, (left + right) / 2, (right - left) / 0.13) end
  sets(ahead, 0, 0)
  s:run(0.2)
  s:equal(devices.hat_out.value, "\x00\x11", "it sleeps until it is woken")
  sets_ahead "\x00\x20"
  sets("\x26" .. channel(2048) .. ON .. OFF .. ON .. OFF .. channel(2048), 0, 0.6 / 0.13)
  sets("\x26" .. ON .. OFF .. ON .. OFF .. ON .. ON, 0, -1.2 / 0.13)
  sets_ahead(ahead)
  s:run(0.2)
  s:equal(devices.hat_out.value, "\x00\x20")
  sets("\x29\x17", right / 2, right / 0.13) -- the last register of channel 8: off, whatever its count
  sets_ahead(ahead)
  sets_ahead "\xFD\x00"
  sets("\xFD\x10", 0, 0)
  sets_ahead(ahead)
  devices:lose_power()
  s:run(0.02)
  s:equal(devices.target_velocity_in.value, { vx = 0, vy = 0, va = 0 })
  sets("\x00\x20", 0, 0)
end)

scenario("the models of the battery monitor and the range finder answer as their data sheets say", { timeout = 5 }, function(s)
  local devices = s:behavior "devices" { script = "hat_rover_devices" }
  local kept = s:behavior "kept" { script = "keeps_all" }
  s:connect("devices.sonar_out", "kept.texts")
  s:connect("devices.battery_out", "kept.bytes")
  s:inject(devices.front, 0.343)
  s:run(0.36)
  s:equal(kept.state.bytes, { "\x02\x39\xD0", "\x02\x39\xD0", "\x02\x39\xD0", "\x02\x39\xD0" }, "7.4 V, every 0.1 s")
  s:inject(devices.sonar_in, "23=0")
  s:inject(devices.sonar_in, "23=1")
  s:run(0.02)
  s:equal(kept.state.texts, {}, "while the trigger is high")
  local begin = s:now()
  s:inject(devices.sonar_in, "23=0")
  s:run(0.03)
  s:equal(kept.state.texts, { ("24=1 %.6f"):format(begin + 0.0005), ("24=0 %.6f"):format(begin + 0.0025) })
  kept:forget()
  s:inject(devices.sonar_in, "23=0")
  s:inject(devices.sonar_in, "24=1")
  s:run(0.03)
  s:equal(kept.state.texts, {}, "a trigger that was low begins nothing")
end)

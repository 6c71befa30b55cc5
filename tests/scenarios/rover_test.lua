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
  s:check(not ok and message:find("rover_driver drives 'rover', which moves: reload it while the robot stands", 1, true), message)
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

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

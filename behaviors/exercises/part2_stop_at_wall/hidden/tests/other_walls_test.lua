scenario("stops at every speed", { timeout = 40, sweep = { speed = { 0.05, 0.2, 0.3 } } }, function(s, p)
  local world = s:load "systems/part2_stop_at_wall.lua"
  world.controller.config.speed_x = p.speed
  s:never("touches the wall", function() return world.mouse.collided end)
  s:wait_until("comes near", { within = 20 }, function() return world.mouse.truth.pose.position.x > 0.4 end)
  s:eventually("stops", { within = 10 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end)
end)

scenario("any of the four sensors stops it", { sweep = { sensor = { 1, 2, 3, 4 } } }, function(s, p)
  s:behavior("controller", { script = "controller", config = { speed_x = 0.2 } })
  local function see(values)
    s:inject("controller.in", values)
    s:run(0.02)
    return s.controller.out.value.vx
  end
  s:near(see { 0, 0, 0, 0 }, 0.2, 1e-9, "drives while the way is free")
  local values = { 0, 0, 0, 0 }
  values[p.sensor] = 31
  s:near(see(values), 0, 1e-9, "stops above stop_d")
  values[p.sensor] = 30
  s:near(see(values), 0.2, 1e-9, "drives at stop_d")
end)

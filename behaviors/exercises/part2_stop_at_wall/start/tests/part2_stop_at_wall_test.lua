scenario("stops before it touches the wall", { timeout = 30 }, function(s)
  local world = s:load "systems/part2_stop_at_wall.lua"
  s:never("touches the wall", function() return world.mouse.collided end)
  s:wait_until("comes near", { within = 15 }, function() return world.mouse.truth.pose.position.x > 0.4 end)
  s:eventually("stops", { within = 10 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end)
end)

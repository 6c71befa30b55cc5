scenario("the gain is 0.8 and the mouse still arrives", function(s)
  local world = s:load "systems/keep_distance"
  s:eventually("has a gain of 0.8", { within = 1 }, function() return math.abs(world.keeper.config.gain - 0.8) < 1e-9 end)
  s:eventually("drives", { within = 5 }, function() return world.mouse.truth.pose.position.x > 0.3 end)
end)

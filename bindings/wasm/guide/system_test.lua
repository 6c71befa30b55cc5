scenario("the mouse keeps its distance in the system", function(s)
  local world = s:load "systems/keep_distance"
  s:never("touches the wall", function() return world.mouse.collided end)
  s:eventually("drives", { within = 5 }, function() return world.mouse.truth.pose.position.x > 0.3 end)
end)

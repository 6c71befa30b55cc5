scenario("drives to the wall and keeps 0.15 m", function(s)
  local world = s:load "systems/guide"
  local function ahead() return 0.75 - 0.035 - world.mouse.truth.pose.position.x end
  s:never("touches the wall", function() return world.mouse.collided end)
  s:maintain("keeps 0.15 m", { within = 10, hold = 2 }, function() return math.abs(ahead() - 0.15) < 0.01 end)
end)

scenario("the right sensor drives forward, the left one backward", { timeout = 30 }, function(s)
  local world = s:load "systems/part3_touch_drive.lua"
  s:press("ev3", "right", 1.5)
  s:eventually("drives forward", { within = 1 }, function() return world.mouse.truth.velocity.vx > 0.19 end)
  s:eventually("stops when it is let go", { within = 3 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end)
  s:press("ev3", "left", 1.5)
  s:eventually("drives backward", { within = 1 }, function() return world.mouse.truth.velocity.vx < -0.19 end)
end)

scenario("the stick drives both robots", { timeout = 30 }, function(s)
  local world = s:load "systems/part3_stick_drive.lua"
  s:hold("stick.stick", { 0, 75 })
  s:eventually("the mouse drives", { within = 2 }, function() return world.mouse.truth.velocity.vx > 0.14 end)
  s:eventually("the EV3 drives", { within = 2 }, function() return world.ev3.truth.velocity.vx > 0.14 end)
end)

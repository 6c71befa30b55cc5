scenario("stops", { timeout = 30, sweep = { speed = { 0.1, 0.2 }, x = range(0, 1) }, samples = 3 }, function(s, p)
  local world = s:load "systems/stop_at_wall.lua"
  world.controller.config.speed_x = p.speed
  s:always("untouched", function() return not world.mouse.collided end)
  s:run(1)
end)

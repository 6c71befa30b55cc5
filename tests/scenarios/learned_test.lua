--- The mice whose weights were learned: learned_stop, learned_corridor.

scenario("a learned mouse stops before the wall from wherever it starts",
  { timeout = 20, sweep = { x = { -0.2, 0, 0.3 } } },
  function(s, p)
    local world = s:load "systems/learned_stop.lua"
    s:teleport(world.mouse, { x = p.x, y = 0, heading = 0 })
    s:never("touches the wall", function() return world.mouse.collided end)
    s:maintain("stands near it", { within = 10, hold = 2 }, function()
      return world.mouse.truth.pose.position.x > 0.585 and math.abs(world.mouse.truth.velocity.vx) < 0.02
    end)
  end)

scenario("a learned mouse follows the corridor around both corners", { timeout = 20 }, function(s)
  local world = s:load "systems/learned_corridor.lua"
  s:never("touches a wall", function() return world.mouse.collided end)
  s:eventually("comes through", { within = 10 }, function() return world.mouse.truth.pose.position.x > 1.4 end)
end)

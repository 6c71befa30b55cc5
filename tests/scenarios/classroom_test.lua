--- The classroom: 20 mice, one controller file, parameters of their own.

scenario("20 mice drive at once, each by its own parameters, and leave each other alone", { timeout = 60 }, function(s)
  local world = s:load "systems/classroom.lua"
  local speeds = {}
  for i = 1, 20 do
    local controller = world["controller_" .. i]
    s:check(controller.status == "ACTIVE")
    speeds[controller.config.stop_d] = true
  end
  local different = 0
  for _ in pairs(speeds) do different = different + 1 end
  s:near(different, 20, 0)
  s:run(0.5)
  for i = 1, 20 do
    local controller, mouse = world["controller_" .. i], world["mouse_" .. i]
    s:near(mouse.truth.velocity.vx, controller.config.speed_x, 0.01, mouse.name)
    s:near(mouse.truth.velocity.va, controller.config.speed_r, 0.05, mouse.name)
  end
  s:run(10)
  for i = 1, 20 do s:check(world["controller_" .. i].status == "ACTIVE") end
end)

scenario("one of 20 that is changed changes alone", function(s)
  local world = s:load "systems/classroom.lua"
  world.controller_7.config.speed_x = 0.0
  world.controller_7.config.speed_r = 0.0
  s:run(0.5)
  s:near(world.mouse_7.truth.velocity.vx, 0, 0.001)
  for _, other in ipairs { 6, 8 } do
    s:near(world["mouse_" .. other].truth.velocity.vx, world["controller_" .. other].config.speed_x, 0.01)
  end
end)

--- Several worlds in one scenario: one clock, nothing in common.

scenario("two worlds of one file are alike, tick by tick", function(s)
  local one = s:load "systems/stop_at_wall.lua"
  local two = s:load "systems/stop_at_wall.lua"
  s:always("they agree", function()
    return one.mouse.truth.pose.position.x == two.mouse.truth.pose.position.x
      and one.mouse.ir_sensor_out.value[1] == two.mouse.ir_sensor_out.value[1]
  end)
  s:run(8)
  s:check(one.mouse.truth.pose.position.x > 0.3, "they drove")
end)

scenario("events in one world do not change the other", function(s)
  local one = s:load "systems/stop_at_wall.lua"
  local two = s:load "systems/stop_at_wall.lua"
  one.controller.config.speed_x = 0.0
  s:run(2)
  s:near(one.mouse.truth.pose.position.x, 0, 1e-6)
  s:check(two.mouse.truth.pose.position.x > 0.15)
end)

scenario("a world that is loaded later begins then", function(s)
  local one = s:load "systems/stop_at_wall.lua"
  s:run(1)
  local two = s:load "systems/stop_at_wall.lua"
  local before = one.mouse.truth.pose.position.x
  s:run(1)
  s:near(two.mouse.truth.pose.position.x, before, 1e-12)
  s:near(s:now(), 2, 1e-9)
end)

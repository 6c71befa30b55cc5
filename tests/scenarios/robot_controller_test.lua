--- RobotController, whole: what it does with its sensors' values, its parameters and its life.

--- A world with the controller alone: values come from the scenario.
local function controller_alone(s, config)
  s:behavior "controller" { script = "robot_controller", config = config }
  return s.controller
end

--- One message, and the tick in which the controller acts on it.
local function see(s, ...)
  s:inject("controller.in", { ... })
  s:run(0.01)
end

scenario("drives as configured while nothing has been seen", function(s)
  local controller = controller_alone(s, { speed_x = 0.2, speed_r = 0.5 })
  s:run(0.01)
  s:near(controller.out.value.vx, 0.2, 0)
  s:near(controller.out.value.va, 0.5, 0)
  s:near(controller.out.value.vy, 0, 0)
end)

scenario("any sensor stops it above stop_d, none at stop_d", { sweep = { sensor = { 1, 2, 3, 4 }, value = { 30, 31 } } },
  function(s, p)
    local controller = controller_alone(s, { speed_x = 0.2, speed_r = 0.5 })
    local values = { 0, 0, 0, 0 }
    values[p.sensor] = p.value
    see(s, table.unpack(values))
    local blocked = p.value > 30
    s:near(controller.out.value.vx, blocked and 0 or 0.2, 0)
    s:near(controller.out.value.va, blocked and 0 or 0.5, 0)
  end)

scenario("sequences of other lengths are looked at as they are", function(s)
  local controller = controller_alone(s, { speed_x = 0.2 })
  see(s)
  s:near(controller.out.value.vx, 0.2, 0)
  see(s, 31)
  s:near(controller.out.value.vx, 0, 0)
  see(s, 0, 0, 0, 0, 0, 0, 0, 4095)
  s:near(controller.out.value.vx, 0, 0)
end)

scenario("the latest sequence counts, and counts until the next", function(s)
  local controller = controller_alone(s, { speed_x = 0.2 })
  s:inject("controller.in", { 31, 0, 0, 0 })
  s:inject("controller.in", { 0, 0, 0, 0 })
  s:run(0.01)
  s:near(controller.out.value.vx, 0.2, 0)
  see(s, 0, 0, 31, 0)
  s:always("stays stopped", function() return controller.out.value.vx == 0 end)
  s:run(1)
end)

scenario("backing away and turning on the spot are never blocked", { sweep = { speed_x = { -0.2, 0.0 } } },
  function(s, p)
    local controller = controller_alone(s, { speed_x = p.speed_x, speed_r = 0.5 })
    see(s, 4095, 4095, 4095, 4095)
    s:near(controller.out.value.vx, p.speed_x, 0)
    s:near(controller.out.value.va, 0.5, 0)
  end)

scenario("its parameters hold from the next tick", function(s)
  local controller = controller_alone(s, { speed_x = 0.2 })
  see(s, 100, 0, 0, 0)
  s:near(controller.out.value.vx, 0, 0)
  controller.config.stop_d = 100
  s:run(0.01)
  s:near(controller.out.value.vx, 0.2, 0)
  controller.config.speed_x = 0.3
  s:run(0.01)
  s:near(controller.out.value.vx, 0.3, 0)
end)

scenario("its parameters have their bounds, and speed 0 by default", function(s)
  local controller = controller_alone(s)
  s:run(0.01)
  s:near(controller.out.value.vx, 0, 0)
  s:near(controller.out.value.va, 0, 0)
  for name, bound in pairs { speed_x = 1.5, speed_r = 2.0 } do
    for _, sign in ipairs { -1, 1 } do
      controller.config[name] = sign * bound
      s:near(controller.config[name], sign * bound, 0)
      s:check(not pcall(function() controller.config[name] = sign * (bound + 0.01) end), name .. " has a bound")
      s:near(controller.config[name], sign * bound, 0)
    end
  end
  s:near(controller.config.stop_d, 30, 0)
  s:check(not pcall(function() controller.config.stop_d = 30.5 end), "stop_d is a whole number")
end)

scenario("deactivation writes zero once, and then nothing", function(s)
  local controller = controller_alone(s, { speed_x = 0.2 })
  s:run(0.1)
  controller:deactivate()
  s:run(0.01)
  s:near(controller.out.value.vx, 0, 0)
  local stamp = controller.out.tm
  s:run(0.1)
  s:near(controller.out.tm, stamp, 0)
end)

scenario("sensor values from before an activation are forgotten", function(s)
  local controller = controller_alone(s, { speed_x = 0.2 })
  see(s, 4095, 0, 0, 0)
  s:near(controller.out.value.vx, 0, 0)
  controller:deactivate()
  s:run(0.05)
  controller:activate()
  s:run(0.01)
  s:near(controller.out.value.vx, 0.2, 0)
end)

scenario("stops in front of the wall at every speed", { sweep = { speed = { 0.05, 0.1, 0.2, 0.3, 0.5 } } }, function(s, p)
  local world = s:load "systems/stop_at_wall.lua"
  world.controller.config.speed_x = p.speed

  s:always("never touches anything", function() return not world.mouse.collided end)
  s:wait_until("under way", { within = 5 }, function() return world.mouse.truth.pose.position.x > 0.1 end)
  s:eventually("stops", { within = 15 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end)
  s:maintain("stays there", { hold = 2, within = 1 }, function() return world.controller.ports["in"].value[1] > 30 end)
end)

scenario("drives on when the way is free again", function(s)
  local world = s:load "systems/stop_at_wall.lua"
  s:eventually("stops", { within = 15 }, function()
    return world.mouse.truth.pose.position.x > 0.3 and math.abs(world.mouse.truth.velocity.vx) < 0.001
  end)
  s:teleport(world.mouse, { x = 0, y = 0, heading = math.pi })
  s:eventually("drives away", { within = 5 }, function() return world.mouse.truth.pose.position.x < -0.1 end)
end)

scenario("backs away from the wall", function(s)
  local world = s:load "systems/stop_at_wall.lua"
  -- A real robot's sensors say nothing in the first ticks.
  s:eventually("is blocked", { within = 15 }, function() return (world.mouse.ir_sensor_out.value[1] or 0) > 30 end)
  local from = world.mouse.truth.pose.position.x
  world.controller.config.speed_x = -0.1
  s:eventually("is away", { within = 5 }, function() return world.mouse.truth.pose.position.x < from - 0.2 end)
end)

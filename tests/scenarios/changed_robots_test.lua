--- Robots that differ from their model: noise and friction drawn at random, sensors of one's own.

local wall = 1.0

--- A mouse drives at a wall and stops before it, whatever its sensors and its wheels are like.
scenario("stops short of the wall, however noisy and smooth it is", {
  timeout = 60,
  sweep = { noise = range(0, 0.1), friction = range(0.3, 1) },
  samples = 5,
}, function(s, p)
  s:arena { s:box { at = { wall + 0.05, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }
  s:robot "mouse" { model = "raspimouse", noise = p.noise, friction = p.friction }
  s:behavior "controller" { script = "robot_controller", config = { speed_x = 0.2 } }
  s:connect("mouse.ir_sensor_out", "controller.in")
  s:connect("controller.out", "mouse.target_velocity_in")
  local mouse = s.mouse
  s:never("touches anything", function() return mouse.collided end)
  s:eventually("stops", { within = 30 }, function()
    return mouse.truth.pose.position.x > 0.5 and math.abs(mouse.truth.velocity.vx) < 0.01
  end)
end)

scenario("the noise of a robot is a part of what its own sensors say", function(s)
  s:arena { s:box { at = { 0.2, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }
  s:robot "mouse" { model = "raspimouse", noise = 0.05 }
  s:robot "plain" { model = "raspimouse", pose = { y = 0.3 } }
  local mouse, plain = s.mouse, s.plain
  s:run(0.1)
  local exact, sum, squares = plain.ir_sensor_out.value[1], 0, 0
  for _ = 1, 500 do
    s:run(0.01)
    s:check(plain.ir_sensor_out.value[1] == exact, "without noise a value stands still")
    local off = mouse.ir_sensor_out.value[1] / exact - 1
    sum, squares = sum + off, squares + off * off
  end
  s:near(sum / 500, 0, 0.01)
  s:near(math.sqrt(squares / 500), 0.05, 0.01)
end)

scenario("a mouse with a laser scanner and an inertial sensor of its own", function(s)
  s:arena { size = { 2, 2 } }
  s:robot "mouse" {
    model = "raspimouse",
    pose = { x = 0.5 },
    sensors = {
      laser = { kind = "scan", at = { 0, 0, 0.03 }, range = 3, rays = 4 },
      imu = { kind = "imu" },
    },
    ports = {
      scan = { type = "RangeData", from = "laser" },
      rates = { type = "TimedDoubleSeq", from = "imu", quantity = "rate" },
      accelerations = { type = "TimedDoubleSeq", from = "imu", quantity = "acceleration" },
    },
  }
  local mouse = s.mouse
  s:run(0.5)
  local scan = mouse.scan.value
  s:near(scan.config.minAngle, -math.pi, 1e-9)
  s:near(scan.config.angularRes, math.pi / 2, 1e-9)
  for i, distance in ipairs { 1.5, 1, 0.5, 1 } do -- behind, right, ahead, left
    s:near(scan.ranges[i], distance, 0.01)
  end
  s:near(mouse.accelerations.value[3], 9.81, 0.05)
  for _ = 1, 10 do
    s:inject("mouse.target_velocity_in", { vx = 0, va = 1 })
    s:run(0.1)
  end
  s:near(mouse.rates.value[3], 1, 0.05)
end)

scenario("a line on the floor is seen from above", function(s)
  s:arena { size = { 2, 2 }, s:line { points = { { 0.3, -0.5 }, { 0.3, 0.5 } }, width = 0.04 } }
  s:robot "mouse" {
    model = "raspimouse",
    sensors = { below = { kind = "reflect", at = { 0.04, 0, -0.03 } } },
    ports = { below = { type = "TimedDouble", from = "below" } },
  }
  local mouse = s.mouse
  s:run(0.1)
  s:check(mouse.below.value > 50, "the plain floor is light")
  s:teleport("mouse", { x = 0.26, y = 0, heading = 0 })
  s:run(0.1)
  s:check(mouse.below.value < 20, "the line is dark")
end)

scenario("the robot of a system also stops short of its wall, with any changes", {
  timeout = 60,
  sweep = { noise = range(0, 0.1), friction = range(0.3, 1), mass = range(0.6, 0.9) },
  samples = 5,
}, function(s, p)
  local world = s:load("systems/stop_at_wall.lua", {
    robots = { mouse = { noise = p.noise, friction = p.friction, mass = p.mass } },
  })
  s:never("touches anything", function() return world.mouse.collided end)
  s:wait_until("under way", { within = 5 }, function() return world.mouse.truth.pose.position.x > 0.1 end)
  s:eventually("stops", { within = 30 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.01 end)
end)

scenario("an unknown field of a robot is refused, and the error lists the possible ones", function(s)
  local function refused(options, text)
    local loaded, message = pcall(s.load, s, "systems/stop_at_wall.lua", options)
    s:check(not loaded and message:find(text, 1, true), tostring(message))
  end
  refused({ robots = { mouse = { nois = 0.1 } } }, "load: robot 'mouse': unknown field 'nois' (did you mean 'noise'?)")
  refused({ robots = { moose = { noise = 0.1 } } }, "load: there is no robot 'moose' (did you mean 'mouse'?)")
  refused({ robot = {} }, "load: unknown option 'robot' (did you mean 'robots'?)")
  refused(5, "load: options expected a table, got number")
end)

scenario("a robot that is added later may differ as well", function(s)
  s:robot "first" { model = "raspimouse" }
  s:run(0.1)
  s:robot "second" {
    model = "raspimouse",
    pose = { y = 0.5 },
    sensors = { imu = { kind = "imu" } },
    ports = { rates = { type = "TimedDoubleSeq", from = "imu", quantity = "rate" } },
  }
  s:run(0.1)
  s:check(#s.second.rates.value == 3)
end)

--- color_follower and camera_line_follower: what they do with what their detectors tell; then whole, from picture to wheels.

--- A behaviour by itself; `told(values)` brings a value to each of its in-ports and gives the velocity that it answers.
local function alone(s, script)
  s:behavior("follower", { script = script })
  return s.follower, function(values)
    for port, value in pairs(values) do s:inject("follower." .. port, value) end
    s:run(0.02)
    return s.follower.target.value
  end
end

local function stops_when_nothing_comes(s, told, values)
  s:run(0.5)
  s:check(s.follower.target.age == math.huge, "silent before anything was seen")
  told(values)
  s:run(0.2)
  s:check(s.follower.target.age > 0.15 and s.follower.target.value.vx > 0, "one look, one command")
  s:eventually("stops", { within = 0.2 }, function() return s.follower.target.value.vx == 0 end)
  s:check(s.follower.target.value.va == 0, "and turns no more")
  s:run(1)
  s:check(s.follower.target.age > 0.9, "it stops once")
  s:check(told(values).vx > 0, "and goes on")
  s.follower:deactivate()
  s:run(0.02)
  s:check(s.follower.target.value.vx == 0, "one that is stopped lets the robot stand")
end

scenario("turns to a coloured thing, and keeps the distance at which it has its size", { timeout = 30 }, function(s)
  local _, told = alone(s, "color_follower")
  local function expect(left, area, vx, va)
    local v = told { centre = { left, 0.3 }, area = area }
    s:near(v.vx, vx, 1e-9)
    s:near(v.va, va, 1e-9)
  end
  expect(0.0, 0.08, 0, 0)
  expect(0.5, 0.08, 0, 0.75)
  expect(-1.0, 0.08, 0, -1.5)
  -- 1.1 times the distance, 0.8 times the distance.
  expect(0.0, 0.08 / 1.1 ^ 2, 0.08, 0)
  expect(0.2, 0.08 / 0.8 ^ 2, -0.16, 0.3)
  -- Not faster than its speed.
  expect(0.0, 0.001, 0.2, 0)
  expect(0.0, 1.0, -0.2, 0)
end)

scenario("a follower of colours stops when nothing is seen", { timeout = 30 }, function(s)
  local _, told = alone(s, "color_follower")
  stops_when_nothing_comes(s, told, { centre = { 0.4, 0 }, area = 0.01 })
end)

local function gap(world)
  local a, b = world.leader.truth.pose.position, world.mouse.truth.pose.position
  return math.sqrt((a.x - b.x) ^ 2 + (a.y - b.y) ^ 2)
end

scenario("a mouse follows the red box that another one carries", {
  timeout = 60,
  sweep = { speed = { 0.08, 0.12 }, turn = { -0.2, 0.0, 0.2 } },
}, function(s, p)
  local world = s:load "systems/color_follower.lua"
  world.driver.config.speed_x, world.driver.config.speed_r = p.speed, p.turn
  s:never("touches anything", function() return world.mouse.collided end)
  s:run(3)
  s:always("not far behind it", function() return gap(world) < 0.38 end)
  s:always("not too near", function() return gap(world) > 0.26 end)
  s:run(15)
  s:check(world.detector.visible.value, "it is in sight")
end)

scenario("a mouse stops when what it follows is lost, and goes on when it is back", { timeout = 30 }, function(s)
  local world = s:load "systems/color_follower.lua"
  world.driver.config.speed_r = 0
  s:wait_until("under way", { within = 3 }, function() return world.mouse.truth.velocity.vx > 0.09 end)
  s:drop "detector.centre"
  local function stands() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end
  s:maintain("stands", { hold = 0.5, within = 0.6 }, stands)
  s:restore "detector.centre"
  s:eventually("goes on", { within = 1 }, function() return world.mouse.truth.velocity.vx > 0.09 end)
end)

scenario("a mouse that looks for another colour stands", { timeout = 10 }, function(s)
  local world = s:load "systems/color_follower.lua"
  world.detector.config.hue_from, world.detector.config.hue_to = 100.0, 140.0
  s:run(2)
  s:check(not world.detector.visible.value, "nothing green is there")
  s:check(world.detector.centre.age == math.huge and world.detector.area.age == math.huge, "silent")
  s:check(world.mouse.truth.pose.position.x < 0.001, "it stands")
end)

scenario("steers by a line's offset and its angle", { timeout = 30 }, function(s)
  local follower, told = alone(s, "camera_line_follower")
  local function expect(offset, angle, va)
    local v = told { offset = offset, angle = angle }
    s:near(v.vx, 0.15, 1e-9)
    s:near(v.va, va, 1e-9)
  end
  expect(0.0, 0.0, 0)
  expect(0.5, 0.0, 0.525)
  expect(0.0, -0.4, -0.15)
  expect(-0.2, 0.56, 0)
  -- The same curve at any speed.
  follower.config.speed = 0.05
  local slow = told { offset = 0.5, angle = 0.0 }
  s:near(slow.vx, 0.05, 1e-9)
  s:near(slow.va, 0.175, 1e-9)
end)

scenario("a follower of lines stops when no line is seen", { timeout = 30 }, function(s)
  local _, told = alone(s, "camera_line_follower")
  stops_when_nothing_comes(s, told, { offset = 0.4, angle = 0.1 })
end)

--- How far a place is from the middle of the line [m]: a rectangle of 1.1 by 0.7 m with corners of radius 0.25 m.
local function from_line(at)
  local dx, dy = math.abs(at.x) - 0.30, math.abs(at.y) - 0.10
  local outside = math.sqrt(math.max(dx, 0) ^ 2 + math.max(dy, 0) ^ 2)
  return math.abs(outside + math.min(math.max(dx, dy), 0) - 0.25)
end

scenario("a mouse goes once round a line that its camera sees", {
  timeout = 90,
  sweep = { speed = { 0.1, 0.25 }, noise = { 0.0, 12.0 }, askew = range(-0.3, 0.3) },
  samples = 1,
}, function(s, p)
  local world = s:load "systems/camera_line_follower.lua"
  world.follower.config.speed = p.speed
  world.eye.config.noise, world.eye.config.blur = p.noise, p.noise / 12
  local mouse = world.mouse
  s:teleport("mouse", { x = 0, y = -0.35, heading = p.askew })
  s:run(2)
  s:always("its wheels stay beside the line", function() return from_line(mouse.truth.pose.position) < 0.025 end)
  s:wait_until("east", { within = 15 }, function() return mouse.truth.pose.position.x > 0.5 end)
  s:wait_until("north", { within = 15 }, function() return mouse.truth.pose.position.y > 0.3 end)
  s:wait_until("west", { within = 20 }, function() return mouse.truth.pose.position.x < -0.5 end)
  s:wait_until("round", { within = 20 }, function()
    return mouse.truth.pose.position.y < -0.3 and mouse.truth.pose.position.x > 0
  end)
end)

scenario("a mouse that has no line before it stands", { timeout = 10 }, function(s)
  local world = s:load "systems/camera_line_follower.lua"
  s:run(1)
  s:check(world.mouse.truth.velocity.vx > 0.1, "under way")
  s:teleport("mouse", { x = 0, y = 0, heading = 0 })
  s:maintain("stands", { hold = 1, within = 1 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end)
  s:check(not world.detector.visible.value, "no line is in sight")
  s:check(world.mouse.truth.pose.position.x < 0.15, "and it did not go far")
end)

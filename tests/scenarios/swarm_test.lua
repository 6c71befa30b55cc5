--- swarm: one robot by itself; then a hundred of them.

--- The velocity that it answers to readings of its sensors, `{ [number] = value, ... }`.
local function told(s, readings)
  local values = {}
  for i = 1, 24 do values[i] = readings[i] or 0 end
  s:inject("walker.rays", values)
  s:run(0.02)
  return s.walker.out.value
end

scenario("a robot of a swarm turns away from near things, and passes far things", function(s)
  local walker = s:behavior "walker" { script = "swarm" }
  s:equal({ walker.config.speed, walker.config.track }, { 0.05, 0.14 })
  local function turns(side, readings)
    local v = told(s, readings)
    s:near(v.vx, 0.025, 1e-9)
    s:near(v.va, side * 0.05 / 0.14, 1e-9)
  end
  local function goes_on(readings) s:equal(told(s, readings), { vx = 0.05, vy = 0, va = 0 }) end

  goes_on {}
  turns(-1, { [2] = 0.5 })
  turns(-1, { [12] = 0.5 })
  turns(1, { [23] = 0.5 })
  turns(1, { [13] = 0.5 })
  turns(-1, { [1] = 0.2, [2] = 0.1 })
  -- Straight ahead: the mean of all readings decides, and to the right if both sides are alike.
  goes_on { [1] = 1.2, [24] = 1.2 }
  goes_on { [1] = 0.5, [24] = 0.45 }
  turns(1, { [1] = 1.25, [24] = 1.25 })
end)

scenario("a robot of a swarm drives at its speed, and turns by its track", function(s)
  local walker = s:behavior "walker" { script = "swarm", config = { speed = 0.1, track = 0.2 } }
  s:near(told(s, { [2] = 1 }).va, -0.5, 1e-9)
  s:near(told(s, { [23] = 1 }).va, 0.5, 1e-9)
  s:near(told(s, {}).vx, 0.1, 1e-9)
  walker.config.speed = 0.2
  s:near(told(s, {}).vx, 0.2, 1e-9)
end)

scenario("a hundred robots begin apart from each other and from the walls of their arena", function(s)
  local world = s:load "systems/swarm.lua"
  local robots, least, farthest, headings = {}, math.huge, 0, 0
  for i = 1, 100 do robots[i] = world["robot_" .. i] end
  s:check(world.swarm_100 and not pcall(function() return world.robot_101 end), "no more than a hundred")
  s:run(0.1)
  for i, robot in ipairs(robots) do
    local pose = robot.truth.pose
    local at = pose.position
    farthest, headings = math.max(farthest, math.abs(at.x), math.abs(at.y)), headings + pose.heading / 100
    for j = 1, i - 1 do
      local other = robots[j].truth.pose.position
      least = math.min(least, math.sqrt((at.x - other.x) ^ 2 + (at.y - other.y) ^ 2))
    end
  end
  s:near(least, 2.2 * 0.085, 0.03)
  s:near(farthest, 5 - 2.2 * 0.085, 0.15)
  s:near(headings, 0, 0.5)
  -- Each wall is where it is said to be: its nearness ahead, in the first and the last sensor.
  for side = 0, 3 do
    local heading = side * math.pi / 2
    s:teleport("robot_1", { x = 4.88 * math.cos(heading), y = 4.88 * math.sin(heading), heading = heading })
    s:run(0.1)
    for _, sensor in ipairs { 1, 24 } do s:near(robots[1].rays.value[sensor], 0.28, 0.03) end
  end
end)

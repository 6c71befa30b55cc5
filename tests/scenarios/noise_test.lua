--- The examples with sensors that deviate by 5 % (standard deviation), each value by its own. `tests/margins` runs this with
--- one seed after the other, and says how near the examples come to their limits.

local DEVIATION = 0.05

local function normal() -- Box and Muller, 1958
  return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

local function deviating(value, most) return math.min(value * (1 + DEVIATION * normal()), most or math.huge) end

--- In the place of the sensors' values, in every tick: the same, deviating. `feeds` has an in-port's path for each port.
local function run(s, seconds, feeds, done)
  for _ = 1, seconds * 100 do
    s:run(0.01)
    for path, port in pairs(feeds) do
      local value = port.value
      if type(value) == "number" then
        s:hold(path, deviating(value, 100))
      elseif #value > 0 then
        local all = {}
        for i = 1, #value do all[i] = deviating(value[i], 0.6) end
        s:hold(path, all)
      end
    end
    if done and done() then return true end
  end
end

--- Odometry of which every step deviates: to be called after each tick.
local function wheels(port)
  local x, y, heading, last = 0, 0, 0, { position = { x = 0, y = 0 }, heading = 0 }
  return function()
    local pose = port.value
    local dx, dy = pose.position.x - last.position.x, pose.position.y - last.position.y
    local way = deviating(dx * math.cos(last.heading) + dy * math.sin(last.heading))
    x, y = x + way * math.cos(heading), y + way * math.sin(heading)
    heading, last = heading + deviating(pose.heading - last.heading), pose
    return { position = { x = x, y = y }, heading = heading }
  end
end

local function distance(a, b) return math.sqrt((a.x - b.x) ^ 2 + (a.y - b.y) ^ 2) end

--- How near the nearest thing is that a mouse's sensors see [m].
local function nearest(mouse)
  local least = 0.6
  for _, seen in ipairs(mouse.ir_sensor_metre_out.value) do least = math.min(least, seen) end
  return least
end

local function off_lane(mouse)
  local at = mouse.truth.pose.position
  return math.min(math.abs((at.x + 0.09) % 0.18 - 0.09), math.abs((at.y + 0.09) % 0.18 - 0.09))
end

local badly_set_down = {
  timeout = 300,
  sweep = { x = range(-0.01, 0.01), y = range(-0.01, 0.01), askew = range(-0.1, 0.1) },
  samples = 1,
}

scenario("wall_follower", badly_set_down, function(s, p)
  local world = s:load "systems/wall_follower.lua"
  local pose = world.mouse.truth.pose
  s:teleport("mouse", { x = pose.position.x + p.x, y = pose.position.y + p.y, heading = pose.heading + p.askew })
  s:always("nothing is nearer than", function() return nearest(world.mouse) > 0.02 end)
  s:never("touches anything", function() return world.mouse.collided end)
  local feeds = { ["follower.ranges"] = world.mouse.ir_sensor_metre_out }
  s:check(run(s, 30, feeds, function() return world.mouse.truth.pose.position.y < -0.3 end), "it comes round to the south")
  run(s, 10, feeds)
end)

--- How far what is so far before the middle of the wheels is from the middle of the line [m]: a rectangle of 1.1 by 0.7 m
--- with corners of radius 0.25 m.
local function from_line(robot, ahead)
  local at = robot.truth.pose
  local x, y = at.position.x + ahead * math.cos(at.heading), at.position.y + ahead * math.sin(at.heading)
  local dx, dy = math.abs(x) - 0.30, math.abs(y) - 0.10
  local outside = math.sqrt(math.max(dx, 0) ^ 2 + math.max(dy, 0) ^ 2)
  return math.abs(outside + math.min(math.max(dx, dy), 0) - 0.25)
end

scenario("line_follower", { timeout = 60, sweep = { y = range(-0.005, 0.005), askew = range(-0.1, 0.1) }, samples = 1 },
  function(s, p)
    local world = s:load "systems/line_follower.lua"
    local pose = world.ev3.truth.pose
    s:teleport("ev3", { x = pose.position.x, y = pose.position.y + p.y, heading = pose.heading + p.askew })
    local feeds = { ["follower.light"] = world.ev3.light_reflect }
    run(s, 1, feeds)
    s:always("its sensor is not farther from the line than", function() return from_line(world.ev3, 0.06) < 0.03 end)
    run(s, 20, feeds)
  end)

scenario("camera_line_follower", {
  timeout = 60,
  sweep = { y = range(-0.01, 0.01), askew = range(-0.2, 0.2) },
  samples = 1,
}, function(s, p)
  local world = s:load "systems/camera_line_follower.lua"
  world.eye.config.noise = 255 * DEVIATION
  s:teleport("mouse", { x = 0, y = -0.35 + p.y, heading = p.askew })
  s:run(2)
  s:always("is not farther from the line than", function() return from_line(world.mouse, 0) < 0.03 end)
  s:run(20)
end)

scenario("color_follower", {
  timeout = 60,
  sweep = { x = range(-0.05, 0.05), askew = range(-0.2, 0.2) },
  samples = 1,
}, function(s, p)
  local world = s:load "systems/color_follower.lua"
  world.eye.config.noise = 255 * DEVIATION
  s:teleport("mouse", { x = p.x, y = 0, heading = p.askew })
  s:run(3)
  s:always("is not farther behind than", function()
    return distance(world.leader.truth.pose.position, world.mouse.truth.pose.position) < 0.38
  end)
  s:never("touches anything", function() return world.mouse.collided end)
  s:run(20)
end)

scenario("go_to_goal", { timeout = 60, sweep = { x = range(0.2, 0.5), y = range(-0.4, 0.4), heading = range(-3, 3) }, samples = 1 },
  function(s, p)
    local world = s:load "systems/go_to_goal.lua"
    local odometry = wheels(world.mouse.current_pose_out)
    s:run(0.1)
    world.driver:go(p.x, p.y, p.heading)
    for _ = 1, 2000 do
      s:run(0.01)
      s:hold("driver.pose", odometry())
      if world.driver.state.mode.current == "rest" then break end
    end
    s:run(1)
    s:maintain("is not farther from the goal than", { hold = 0.1, within = 0.1 }, function()
      return distance(world.mouse.truth.pose.position, p) < 0.03
    end)
  end)

scenario("way_finder", badly_set_down, function(s, p)
  local world = s:load "systems/way_finder.lua"
  s:teleport("mouse", { x = p.x, y = p.y, heading = p.askew / 2 })
  s:always("nothing is nearer than", function() return nearest(world.mouse) > 0.02 end)
  s:never("touches anything", function() return world.mouse.collided end)
  s:check(run(s, 80, { ["finder.ranges"] = world.mouse.ir_sensor_metre_out }, function()
    return distance(world.mouse.truth.pose.position, { x = 1.2, y = 0 }) < 0.1
  end), "it is there")
end)

for name, goal in pairs { left_hand = { x = 1.26, y = 1.26 }, flood_fill = { x = 0.54, y = 0.54 } } do
  scenario(name, badly_set_down, function(s, p)
    local world = s:load("systems/" .. name .. ".lua")
    s:teleport("mouse", { x = p.x, y = p.y, heading = math.pi / 2 + p.askew })
    s:always("is not farther from the middle of the lane than", function() return off_lane(world.mouse) < 0.03 end)
    s:never("touches anything", function() return world.mouse.collided end)
    s:check(run(s, 200, { ["solver.ranges"] = world.mouse.ir_sensor_metre_out }, function()
      return world.solver.tasks.solve.status == "finished"
    end), "it has finished")
    s:check(distance(world.mouse.truth.pose.position, goal) < 0.03, "it is there")
  end)
end

scenario("localisation", {
  timeout = 60,
  sweep = { x = range(-0.05, 0.05), y = range(-0.05, 0.05), heading = range(-0.2, 0.2) },
  samples = 1,
}, function(s, p)
  local world = s:load "systems/localisation.lua"
  s:teleport("mouse", { x = 0.38 + p.x, y = -0.1 + p.y, heading = 1.8 + p.heading })
  local odometry = wheels(world.mouse.current_pose_out)
  local function off() return distance(world.place.pose.value.position, world.mouse.truth.pose.position) end
  for tick = 1, 2000 do
    s:run(0.01)
    s:hold("place.odometry", odometry())
    if tick == 400 then
      s:always("is not farther from where it believes to be than", function() return off() < 0.1 end)
    end
  end
end)

scenario("flock", { timeout = 60, sweep = { x = range(-0.05, 0.05), heading = range(-3, 3) }, samples = 1 }, function(s, p)
  -- Seven of the system's fifty: so many take longer than the other examples together.
  local near = { kind = "neighbours", radius = 0.8, noise = 0.01, bearing_noise = 0.03, loss = 0.1 }
  local mice, feeds = {}, {}
  for i = 1, 7 do
    local away, angle = 0.22 * math.sqrt(i), 2.4 * i
    local pose = { x = away * math.cos(angle), y = away * math.sin(angle), heading = i * i % (2 * math.pi) }
    if i == 1 then pose.x, pose.heading = pose.x + p.x, p.heading end
    local mouse, bird = "mouse_" .. i, "flock_" .. i
    mice[i] = s:robot(mouse, {
      model = "raspimouse",
      pose = pose,
      sensors = { near = near },
      ports = { near = { type = "NeighbourSeq", from = "near" }, say = { type = "TimedDoubleSeq", to = "say" } },
    })
    s:behavior(bird, { script = "flock", config = { initial = { pose.x, pose.y, pose.heading } } })
    s:connect(mouse .. ".near", bird .. ".others")
    s:connect(mouse .. ".current_pose_out", bird .. ".pose")
    s:connect(bird .. ".say", mouse .. ".say")
    s:connect(bird .. ".target", mouse .. ".target_velocity_in")
    feeds[bird .. ".ranges"] = mice[i].ir_sensor_metre_out
  end
  local function apart()
    local least = 1
    for i = 1, 7 do
      for j = i + 1, 7 do
        least = math.min(least, distance(mice[i].truth.pose.position, mice[j].truth.pose.position))
      end
    end
    return least
  end
  s:always("two are not nearer than", function() return apart() > 0.105 end)
  run(s, 20, feeds)
end)

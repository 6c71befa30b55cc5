--- localisation, distance_estimator and flock: who knows more than its own wheels say.

local poses = require "nezumi.poses"

local function distance(a, b) return math.sqrt((a.x - b.x) ^ 2 + (a.y - b.y) ^ 2) end

scenario("markers put right what odometry gets wrong", {
  timeout = 60,
  sweep = { x = range(-0.05, 0.05), y = range(-0.05, 0.05), heading = range(-0.2, 0.2), push = range(-2, 2) },
  samples = 2,
}, function(s, p)
  local world = s:load "systems/localisation.lua"
  local function of(port) return distance(port.value.position, world.mouse.truth.pose.position) end
  s:teleport("mouse", { x = 0.38 + p.x, y = -0.1 + p.y, heading = 1.8 + p.heading })
  s:run(0.1)
  s:check(of(world.place.pose) > 0.02, "it does not know yet that it was set down elsewhere")
  s:run(3.9)

  -- A hand pushes it aside twice: its wheels do not tell.
  local filter, wheels, count = 0, 0, 0
  s:always("knows where it is", function() return of(world.place.pose) < 0.15 end)
  for _, push in ipairs { p.push, -p.push / 2 } do
    s:disturb("mouse", { va = push, seconds = 0.5 })
    for _ = 1, 100 do
      s:run(0.1)
      filter, wheels, count = filter + of(world.place.pose) ^ 2, wheels + of(world.place.dead_reckoning) ^ 2, count + 1
    end
  end
  filter, wheels = math.sqrt(filter / count), math.sqrt(wheels / count)
  s:check(filter < wheels / 4, ("mean error of the filter %.3f m, of odometry %.3f m"):format(filter, wheels))
  s:check(of(world.place.pose) < 0.03, "the filter is right in the end")
  local sure = world.place.deviation.value
  s:check(sure[1] < 0.05 and sure[2] < 0.05 and sure[3] < 0.1, "and knows it")
end)

scenario("without markers in sight the filter goes on by odometry, and is less and less sure", { timeout = 30 }, function(s)
  local world = s:load "systems/localisation.lua"
  s:run(5)
  local sure = world.place.deviation.value[1]
  s:drop("detector.pos")
  s:run(0.1)
  local pose, dead = world.place.pose.value, world.place.dead_reckoning.value
  s:run(5)
  local function moved(a, b) return distance(a.position, b.position) end
  s:near(moved(world.place.pose.value, pose), moved(world.place.dead_reckoning.value, dead), 1e-6)
  s:check(world.place.deviation.value[1] > sure + 0.02)
  s:restore("detector.pos")
  s:eventually("sure again", { within = 10 }, function() return world.place.deviation.value[1] < sure + 0.01 end)
end)

scenario("a Kalman filter tells the mouse's speed from its distance to the wall", { timeout = 30 }, function(s)
  s:arena { s:box { at = { 0.65, 0.0 }, size = { 0.1, 1.0, 0.3 } } }
  s:robot "mouse" { model = "raspimouse" }
  s:behavior "estimator" { script = "distance_estimator" }
  local estimator = s.estimator
  s:connect("mouse.ir_sensor_metre_out", "estimator.seen")
  s:hold("mouse.target_velocity_in", { vx = 0.1 })
  s:run(2)
  s:near(estimator.estimate.value[1], s.mouse.ir_sensor_metre_out.value[1], 0.005)
  s:near(estimator.estimate.value[2], -0.1, 0.005)
  local ok, message = s:reload("estimator", { file = "distance_estimator" })
  s:check(ok, message)
  s:check(#estimator.state.p == 2 and #estimator.state.p[1] == 2, "state shows the rows")
  s:always("the estimate goes on", function() return math.abs(estimator.estimate.value[2] + 0.1) < 0.01 end)
  s:run(0.5)
end)

scenario("the estimate is that of a Kalman filter, step by step", { timeout = 5 }, function(s)
  local estimator = s:behavior "estimator" { script = "distance_estimator" }
  local config = estimator.config
  s:equal({ config.deviation, config.acceleration }, { 0.01, 1.0 })
  config.deviation, config.acceleration = 0.2, 3.0
  s:run(0.02)
  s:equal(estimator.estimate.age, math.huge, "silent before something was seen")

  -- The same by hand: distance d, speed v, and their covariance { { a, b }, { b, c } }.
  local d, v, a, b, c, dt = 0, 0, 1, 0, 1, 0.01
  local function step(measured)
    d = d + v * dt
    a, b, c = a + 2 * dt * b + dt * dt * c + 9 * dt ^ 4 / 4, b + dt * c + 9 * dt ^ 3 / 2, c + 9 * dt ^ 2
    local off, spread = measured - d, a + 0.2 ^ 2
    d, v = d + a / spread * off, v + b / spread * off
    a, b, c = a - a * a / spread, b - a * b / spread, c - b * b / spread
  end
  local function sees(ranges, nearer)
    s:inject("estimator.seen", ranges)
    s:run(0.01)
    step(nearer)
    s:near(estimator.estimate.value[1], d, 1e-9)
    s:near(estimator.estimate.value[2], v, 1e-9)
  end
  sees({ 0.5, 0.1, 0.1, 0.6 }, 0.5)
  sees({ 0.55, 0.1, 0.1, 0.45 }, 0.45)
  sees({ 0.4 }, 0.4)
  s:check(s:reload("estimator", { file = "distance_estimator" }))
  sees({ 0.3, 0.5 }, 0.3)
  for i = 1, 20 do sees({ 0.3 + 0.01 * i, 1 }, 0.3 + 0.01 * i) end
end)

scenario("mice that look in all directions become a flock", {
  timeout = 60,
  sweep = { one = range(-0.05, 0.05), two = range(-0.05, 0.05), three = range(-3, 3) },
  samples = 1,
}, function(s, p)
  local world = s:load "systems/flock.lua"
  local mice = {}
  for i = 1, 50 do mice[i] = world["mouse_" .. i] end
  local pose = mice[1].truth.pose
  local begin = { pose.position.x + p.one, pose.position.y + p.two, p.three }
  s:teleport("mouse_1", { x = begin[1], y = begin[2], heading = begin[3] })
  world.flock_1.config.initial = begin

  local function nearest()
    local at, least = {}, math.huge
    for i, mouse in ipairs(mice) do at[i] = mouse.truth.pose.position end
    for i = 1, #at do
      local x, y = at[i].x, at[i].y
      for j = i + 1, #at do least = math.min(least, (at[j].x - x) ^ 2 + (at[j].y - y) ^ 2) end
    end
    return math.sqrt(least)
  end
  --- 1 when all drive in one direction (the order parameter of Vicsek, Physical Review Letters 1995).
  local function order()
    local x, y = 0, 0
    for _, mouse in ipairs(mice) do
      local heading = mouse.truth.pose.heading
      x, y = x + math.cos(heading), y + math.sin(heading)
    end
    return math.sqrt(x * x + y * y) / #mice
  end
  s:check(order() < 0.6, "no flock yet")
  -- Ten times a second: fifty poses take longer to read than a tick.
  local since
  for _ = 1, 250 do
    s:run(0.1)
    s:check(nearest() > 0.105, "they keep off each other")
    since = order() > 0.95 and (since or s:now()) or nil
    if since and s:now() - since > 3 then break end
  end
  s:check(since and s:now() - since > 3, "they drive in one direction for 3 s")
  s:run(3)
  for _, mouse in ipairs(mice) do
    s:check(distance(mouse.truth.pose.position, { x = 0, y = 0 }) < 2.2, "they stay near home")
  end
end)

--- The filter alone: `at` moves it by odometry, perhaps with a marker in sight.
local function filter_alone(s, config)
  local place = s:behavior "place" { script = "localisation", config = config }
  s:run(0.02)
  s:equal(place.pose.age, math.huge, "silent before its wheels have said something")
  return place, function(x, y, heading, id, seen_x, seen_y)
    s:inject(place.odometry, { position = { x = x, y = y }, heading = heading })
    if id then
      s:inject(place.id, id)
      s:inject(place.marker, { position = { x = seen_x, y = seen_y } })
    end
    s:run(0.01)
  end
end

local function is_at(s, port, x, y, heading)
  s:near(port.value.position.x, x, 1e-9)
  s:near(port.value.position.y, y, 1e-9)
  s:near(port.value.heading, heading, 1e-9)
end

local function is_sure(s, place, a, b, c)
  for i, variance in ipairs { a, b, c } do s:near(place.deviation.value[i], math.sqrt(variance), 1e-9) end
end

scenario("the filter moves as the wheels say, and is less sure with each step", { timeout = 5 }, function(s)
  local place, at = filter_alone(s, { initial = { 1.0, 2.0, 0.5 } })
  s:equal({ place.config.markers, place.config.camera, place.config.latency }, { { 0.0, 1.0, 0.0 }, 0.05, 0.04 })
  at(7, 8, 0.9)
  is_at(s, place.pose, 1, 2, 0.5)
  local a, c = 0.04 + 0.0009 * 0.01, 0.09 + 0.04 * 0.01
  is_sure(s, place, a, a, c)
  at(7 + 0.1 * math.cos(0.9), 8 + 0.1 * math.sin(0.9), 1.0)
  local x, y = 0.1 * math.cos(0.5), 0.1 * math.sin(0.5)
  is_at(s, place.pose, 1 + x, 2 + y, 0.6)
  is_at(s, place.dead_reckoning, 1 + x, 2 + y, 0.6)
  is_sure(s, place, a + y * y * c + 9e-6, a + x * x * c + 9e-6, c + 4e-4)
  s:check(s:reload("place", { file = "localisation" }))
  at(7 + 0.1 * math.cos(0.9), 8 + 0.1 * math.sin(0.9), 1.0)
  is_at(s, place.pose, 1 + x, 2 + y, 0.6)
  is_sure(s, place, a + y * y * c + 2 * 9e-6, a + x * x * c + 2 * 9e-6, c + 2 * 4e-4)
end)

scenario("a marker puts the filter right as far as it is unsure", { timeout = 5, sweep = { heading = { 0.0, 0.5, 2.5 } } }, function(s, p)
  local along, across = math.cos(p.heading), math.sin(p.heading)
  -- The first marker is 1 m ahead.
  local place, at = filter_alone(s, { initial = { 1.0, 2.0, p.heading }, markers = { 3.0, 1 + along, 2 + across, 4.0, 9.0, 9.0 } })
  at(0, 0, 0)
  at(0, 0, 0, 5, 0.5, 0.5)
  is_at(s, place.pose, 1, 2, p.heading)
  local a, c = 0.04 + 3 * 9e-6, 0.09 + 3 * 4e-4
  at(0, 0, 0, 3, 0.85, 0.02) -- from the camera
  local r = 0.02 ^ 2 * (0.9 ^ 2 + 0.02 ^ 2)
  local nearer, beside, turned = a / (a + r) * 0.1, a / (a + c + r) * -0.02, c / (a + c + r) * -0.02
  is_at(s, place.pose, 1 + along * nearer - across * beside, 2 + across * nearer + along * beside, p.heading + turned)
  is_at(s, place.dead_reckoning, 1, 2, p.heading)
  local ahead, aside = a - a * a / (a + r), a - a * a / (a + c + r)
  is_sure(s, place, along ^ 2 * ahead + across ^ 2 * aside, across ^ 2 * ahead + along ^ 2 * aside, c - c * c / (a + c + r))
end)

scenario("a marker on the left says more of the heading the farther ahead it seems", { timeout = 5 }, function(s)
  local place, at = filter_alone(s, { markers = { 3.0, 0.0, 1.0, 4.0, 9.0, 9.0 } })
  s:equal(place.config.initial, { 0.0, 0.0, 0.0 })
  local a, c = 0.04 + 9e-6, 0.09 + 4e-4
  at(0, 0, 0, 3, 0.05, 0.9)
  local r = 0.02 ^ 2 * (0.1 ^ 2 + 0.9 ^ 2)
  is_at(s, place.pose, -a / (a + c + r) * 0.1, a / (a + r) * 0.1, c / (a + c + r) * 0.1)
end)

scenario("the filter counts the way since the picture of a marker was taken", { timeout = 5 }, function(s)
  local place, at = filter_alone(s, { markers = { 0.0, 1.0, 0.0 } })
  for i = 0, 9 do at(0.01 * i, 0, 0) end
  at(0.1, 0, 0, 0, 0.9, 0)
  -- When the picture was taken, 0.04 s ago, the marker was 0.95 m ahead: 0.91 m by now.
  local a, r = 0.04 + 11 * 9e-6, 0.02 ^ 2 * 0.91 ^ 2
  is_at(s, place.pose, 0.1 - a / (a + r) * 0.01, 0, 0)
  s:equal(#place.state.odometry, 5)
end)

--- One of the flock alone; `meets` brings it the others at { x, y, heading } and gives what it answers.
local function bird_alone(s, config)
  local bird = s:behavior "bird" { script = "flock", config = config }
  return bird, function(x, y, heading, others, ranges)
    s:inject(bird.pose, { position = { x = x, y = y }, heading = heading })
    s:inject(bird.ranges, ranges or { 1, 1, 1, 1 })
    local here = poses.compose(poses.plane(table.unpack(bird.config.initial)), { position = { x = x, y = y }, heading = heading })
    local seen = {}
    for i, other in ipairs(others) do
      local dx, dy = other[1] - here.position.x, other[2] - here.position.y
      seen[i] = { name = "other_" .. i, range = math.sqrt(dx ^ 2 + dy ^ 2), bearing = math.atan(dy, dx) - here.heading, message = { other[3] } }
    end
    s:inject(bird.others, seen)
    s:run(0.01)
    return bird.target.value
  end
end

scenario("one of a flock weighs distance, direction and company", { timeout = 5 }, function(s)
  local bird, meets = bird_alone(s)
  local config = bird.config
  s:equal({ config.initial, config.speed, config.apart, config.separation, config.alignment, config.cohesion, config.home },
    { { 0.0, 0.0, 0.0 }, 0.12, 0.3, 8.0, 1.0, 0.5, 1.8 })
  s:equal(meets(0, 0, 1, {}), { vx = 0.12, vy = 0, va = 0 }, "alone it goes on")
  s:near(bird.say.value[1], 1, 1e-9, "it says its heading")

  -- It wishes to go along (x, y).
  config.apart, config.separation, config.home = 0.25, 4, 0.8
  local function wishes(x, y, at_x, at_y, others)
    local direction = math.atan(y, x)
    local v = meets(at_x, at_y, direction - 0.2, others)
    s:near(v.vx, 0.12 * math.cos(0.2), 1e-6)
    s:near(v.va, 3 * 0.2, 1e-6)
  end
  wishes(-0.9, 1, 0, 0, { { 0.2, 0, math.pi / 2 } }) -- apart by 4 * 0.25, along by 1, together by 0.1
  wishes(1, -0.9, 0, 0, { { 0, 0.2, 0 } })
  wishes(1 + 0.15, 0.2, 0, 0, { { 0.3, 0.4, 0 } }) -- far enough
  wishes(-0.75, 0.3, 0, 0, { { 0.3, 0.4, 0 }, { 0.2, 0, math.pi / 2 }, { 0, 0.2, 0 }, { -1, 0, math.pi }, { 1, 0, math.pi } })
  wishes(-4 * 24 + 0.0005, 1, 0, 0, { { 0.001, 0, math.pi / 2 } }) -- nearly at the same place
  -- Home is as strong as 100 for each metre beyond.
  wishes(-100 * 0.05 - 2, 0, 0.85, 0, { { 0.85, 0.25, math.pi }, { 0.85, -0.25, math.pi } })
  wishes(-100 * 0.05, 1.15, 0.85, 0, { { 0.85, 0.3, math.pi / 2 } })
  s:near(meets(0, 0, 0.2, { { 0.3, 0, 0 } }).va, -0.6, 1e-6, "straight along x")
  wishes(-100 * 0.1 * 0.6, -100 * 0.1 * 0.8, 0.54, 0.72, {})
end)

scenario("one of a flock turns at its rate, and waits with something in its way", { timeout = 5 }, function(s)
  local bird, meets = bird_alone(s, { initial = { 0.1, 0.2, 1.0 } })
  local function turns(heading, vx, va, ranges)
    local v = meets(0, 0, heading - 1, { { 0.1, 0.7, 0 } }, ranges)
    s:near(v.vx, vx, 1e-6)
    s:near(v.va, va, 1e-6)
  end
  -- It wishes to go along (1, 0.25).
  local wish = math.atan(0.25, 1)
  turns(wish + 0.6, 0.12 * math.cos(0.6), -1.8)
  turns(wish - 0.7, 0.12 * math.cos(0.7), 2)
  turns(wish + 0.7, 0.12 * math.cos(0.7), -2)
  turns(wish + 1.7, 0, -2)
  turns(wish - 0.1, 0, 0.3, { 0.07, 1, 1, 1 })
  turns(wish - 0.1, 0, 0.3, { 1, 1, 1, 0.07 })
  turns(wish - 0.1, 0.12 * math.cos(0.1), 0.3, { 0.09, 0.01, 0.01, 0.09 })
  turns(wish - 0.1, 0, 0.3, { 0.07 })
  turns(wish - 0.1, 0.12 * math.cos(0.1), 0.3, {})
  meets(0.1, 0, 0.5, {})
  s:near(bird.say.value[1], 1.5, 1e-9)
end)

--- Sensors of kind `neighbours`, and what robots say.

local function near(more)
  local sensor = { kind = "neighbours", radius = 1 }
  for name, value in pairs(more or {}) do sensor[name] = value end
  return { near = sensor }
end

local function talker(s, name, x, y, heading, more, silence)
  return s:robot(name, {
    model = "raspimouse",
    pose = { x = x, y = y, heading = heading or 0 },
    sensors = near(more),
    ports = {
      near = { type = "NeighbourSeq", from = "near" },
      say = { type = "TimedDoubleSeq", to = "say", silence = silence },
    },
  })
end

local function seen_by(robot)
  local names = {}
  for _, each in ipairs(robot.near.value) do names[#names + 1] = each.name end
  return names
end

scenario("robots in sight are seen with range, bearing and what they say, the nearest first", function(s)
  local a = talker(s, "a", 0, 0, math.pi / 2)
  talker(s, "b", 0.4, 0.3)
  talker(s, "c", 0, -0.3)
  talker(s, "far", 1.2, 0)
  s:run(0.05)
  s:equal(seen_by(a), { "c", "b" })
  local c, b = a.near.value[1], a.near.value[2]
  s:near(b.range, 0.5, 0.002)
  s:near(b.bearing, math.atan(0.3, 0.4) - math.pi / 2, 0.005)
  s:near(math.abs(c.bearing), math.pi, 0.005)
  s:equal(b.message, {})
  s:hold("b.say", { 1, 2.5 })
  s:run(0.02)
  s:equal(a.near.value[2].message, { 1, 2.5 })
  s:release("b.say")
  s:run(1)
  s:equal(a.near.value[2].message, { 1, 2.5 }, "it holds")
end)

scenario("what a robot says is seen in the next tick, by those before it and by those after it", function(s)
  local first, speaker, last = talker(s, "first", -0.3, 0), talker(s, "speaker", 0, 0), talker(s, "last", 0, 0.3)
  s:run(0.05)
  s:inject("speaker.say", { 7 })
  local function heard(robot)
    for _, each in ipairs(robot.near.value) do
      if each.name == "speaker" then return each.message[1] end
    end
  end
  s:run(0.01)
  s:check(heard(first) == nil and heard(last) == nil, "not in the same tick")
  s:run(0.01)
  s:check(heard(first) == 7 and heard(last) == 7, "in the next one")
end)

scenario("walls, boxes and other robots hide those behind them", function(s)
  s:arena { s:wall { from = { 0.25, -0.2 }, to = { 0.25, 0.2 } }, s:box { at = { 0.25, 0.6, 0.01 }, size = { 0.1, 0.1, 0.02 } } }
  local a = talker(s, "a", 0, 0)
  talker(s, "behind_wall", 0.5, 0)
  talker(s, "beside_wall", 0.1, 0.4)
  local left = talker(s, "left", 0, 0.6)
  talker(s, "behind_low_box", 0.5, 0.6)
  talker(s, "in_line", 0, -0.3)
  talker(s, "behind_robot", 0, -0.6)
  s:run(0.05)
  s:equal(seen_by(a), { "in_line", "beside_wall", "left", "behind_low_box" })
  local names = table.concat(seen_by(left), " ")
  s:check(names:find "behind_low_box" ~= nil, "a low box hides nothing: " .. names)
  s:teleport("behind_wall", { x = 0.5, y = -0.45, heading = 0 })
  s:run(0.05)
  s:check(table.concat(seen_by(a), " "):find "behind_wall" ~= nil, "it is seen past the wall's end")
end)

scenario("noise and loss are as described", { timeout = 20 }, function(s)
  local a = talker(s, "a", 0, 0, 0, { noise = 0.02, bearing_noise = 0.05, loss = 0.25, radius = 2 })
  s:robot("b", { model = "raspimouse", pose = { x = 0, y = 1 } })
  local there, ranges, bearings = 0, { sum = 0, squares = 0 }, { sum = 0, squares = 0 }
  local function add(to, value) to.sum, to.squares = to.sum + value, to.squares + value * value end
  local COUNT = 1000
  for _ = 1, COUNT do
    s:run(0.01)
    local b = a.near.value[1]
    if b then
      there = there + 1
      add(ranges, b.range)
      add(bearings, b.bearing)
    end
  end
  local function deviation(of) return math.sqrt(of.squares / there - (of.sum / there) ^ 2) end
  s:near(there / COUNT, 0.75, 0.04)
  s:near(ranges.sum / there, 1, 0.01)
  s:near(deviation(ranges), 0.02, 0.003)
  s:near(bearings.sum / there, math.pi / 2, 0.01)
  s:near(deviation(bearings), 0.05, 0.007)
end)

scenario("a message is cut after ten numbers, and one line says so", function(s)
  local a = talker(s, "a", 0, 0)
  talker(s, "b", 0.3, 0)
  s:inject("b.say", { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 })
  s:run(0.05)
  s:equal(a.near.value[1].message, { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 })
end)

scenario("a robot whose port says so is silent after half a second without a message", function(s)
  local a = talker(s, "a", 0, 0)
  talker(s, "b", 0.3, 0, 0, nil, "off")
  s:inject("b.say", { 3 })
  s:run(0.3)
  s:equal(a.near.value[1].message, { 3 })
  s:run(0.4)
  s:equal(a.near.value[1].message, {})
end)

scenario("a robot that is added is seen, and one that moves away is not", function(s)
  local a = talker(s, "a", 0, 0)
  talker(s, "b", 0.3, 0)
  s:run(0.05)
  s:equal(seen_by(a), { "b" })
  talker(s, "c", 0, 0.35)
  s:run(0.05)
  s:equal(seen_by(a), { "b", "c" })
  s:teleport("b", { x = 1.5, y = 0, heading = 0 })
  s:run(0.05)
  s:equal(seen_by(a), { "c" })
end)

scenario("the radius counts to the middle of the other robot", function(s)
  local a = talker(s, "a", 0, 0)
  talker(s, "inside", 0.999, 0)
  talker(s, "outside", 0, 1.001)
  s:run(0.05)
  s:equal(seen_by(a), { "inside" })
end)

scenario("a sensor that looks to the left and sits in front measures from there", function(s)
  local a = talker(s, "a", 0, 0, 0, { at = { 0.05, 0, 0 }, yaw = math.pi / 2 })
  talker(s, "b", 0.55, 0)
  s:run(0.05)
  s:near(a.near.value[1].range, 0.5, 0.002)
  s:near(a.near.value[1].bearing, -math.pi / 2, 0.005)
end)

scenario("robots of other models are seen with their LEDs, and those without have none", function(s)
  local a = talker(s, "a", 0, 0)
  s:robot("brick", { model = "ev3", pose = { x = 0.4, y = 0, heading = 0 } })
  s:robot("disc", { model = "swarm_robot", pose = { x = 0, y = 0.5, heading = 0 } })
  s:run(0.05)
  s:equal(seen_by(a), { "brick", "disc" })
  s:equal(a.near.value[1].leds, {})
  s:inject("brick.leds", { true, false, false, true })
  s:run(0.01)
  s:equal(a.near.value[1].leds, {}, "not in the same tick")
  s:run(0.01)
  s:equal(a.near.value[1].leds, { true, false, false, true })
  s:equal(a.near.value[2].leds, {})
end)

scenario("a slower port has the robots of its own ticks", function(s)
  local a = s:robot("a", {
    model = "raspimouse",
    sensors = near(),
    ports = { near = { type = "NeighbourSeq", from = "near", rate = 10 } },
  })
  s:robot("b", { model = "raspimouse", pose = { x = 0.3, y = 0 } })
  s:run(0.2)
  local tm = a.near.tm
  s:run(0.05)
  s:check(a.near.tm - tm < 0.001 or a.near.tm - tm > 0.09, "one message in 0.1 s")
  s:equal(seen_by(a), { "b" })
end)

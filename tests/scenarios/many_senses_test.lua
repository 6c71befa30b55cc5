--- localisation and flock: who knows more than its own wheels say.

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

scenario("mice that look in all directions become a flock", {
  timeout = 60,
  sweep = { one = range(-0.05, 0.05), two = range(-0.05, 0.05), three = range(-3, 3) },
  samples = 2,
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
  s:always("keep off each other", function() return nearest() > 0.105 end)
  s:maintain("drive in one direction", { hold = 3, within = 25 }, function() return order() > 0.95 end)
  s:run(10)
  for _, mouse in ipairs(mice) do
    s:check(distance(mouse.truth.pose.position, { x = 0, y = 0 }) < 2.2, "they stay near home")
  end
end)

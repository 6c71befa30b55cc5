--- The spreadsheet exercise: RobotController alone, its sensors played by hand. 31 and 30 lie on either side of stop_d.

local function alone(s)
  local world = s:load "systems/controller_alone.lua"
  s:run(0.02)
  return world.controller
end

scenario("without values it drives", function(s)
  local controller = alone(s)
  s:near(controller.out.value.vx, 0.2, 0)
  s:near(controller.out.value.va, 0, 0)
  s:check(controller.out.peers[1] == nil, "nobody is told")
end)

scenario("a value fed by hand stops it above stop_d, and no longer at it", { sweep = { sensor = { 1, 2, 3, 4 } } },
  function(s, p)
    local controller = alone(s)
    local function feed(value)
      local values = { 0, 0, 0, 0 }
      values[p.sensor] = value
      s:inject("controller.in", values)
      s:run(0.02)
      return controller.out.value.vx
    end
    s:near(feed(31), 0, 0)
    s:near(feed(30), 0.2, 0)
    s:near(feed(31), 0, 0)
  end)

scenario("a held value is fed every tick, until it is released", function(s)
  local controller = alone(s)
  s:hold("controller.in", { 31, 0, 0, 0 })
  s:run(0.02)
  s:maintain("stands", { hold = 1, within = 0 }, function() return controller.out.value.vx == 0 end)
  s:check(controller.ports["in"].override == "held" and controller.ports["in"].age < 0.02)
  s:release "controller.in"
  s:run(0.02)
  s:near(controller.out.value.vx, 0, 0, "the last value stands, as when a connection falls silent")
  s:inject("controller.in", { 30, 0, 0, 0 })
  s:run(0.02)
  s:near(controller.out.value.vx, 0.2, 0)
end)

scenario("a value that does not fit the port is refused, and changes nothing", function(s)
  local controller = alone(s)
  for _, wrong in ipairs { { "near" }, { 30.5 }, { 40000 }, { true } } do
    local ok, message = pcall(s.inject, s, "controller.in", wrong)
    s:check(not ok and message:find("input 'in' (TimedShortSeq): element 1 expected", 1, true), message)
  end
  s:run(0.1)
  s:near(controller.out.value.vx, 0.2, 0)
  s:check(controller.status == "ACTIVE")
  s:check(controller.ports["in"].age == math.huge, "nothing came")
end)

--- Robots that do one thing after the other: behaviours with tasks, and the systems that use them.

scenario("an EV3 drives 20 cm, turns a quarter, waits for a touch, and goes on", function(s)
  local world = s:load "systems/errand.lua"
  local ev3, driver = world.ev3, world.driver
  local function way() return ev3.truth.pose.position end
  s:eventually("has driven", { within = 4 }, function() return way().x > 0.199 end)
  s:eventually("has turned", { within = 4 }, function()
    return math.abs(ev3.truth.pose.heading - math.pi / 2) < 0.1 and math.abs(ev3.truth.velocity.va) < 0.001
  end)
  s:near(way().x, 0.2, 0.03)
  s:near(way().y, 0, 0.03)
  local here = way().y
  s:run(3)
  s:near(way().y, here, 0.001, "it waits")
  s:check(driver.tasks.errand.status == "waiting", driver.tasks.errand.status)
  s:check(driver.tasks.errand.waiting == "a condition")
  s:press("ev3", "left", 0.5)
  s:run(0.4)
  s:near(way().y, here, 0.001, "it still waits: the sensor is pressed")
  s:eventually("goes on", { within = 4 }, function() return way().y > here + 0.19 end)
end)

scenario("an errand goes step by step, by what odometry and touch sensors say", { timeout = 20 }, function(s)
  local driver = s:behavior "driver" { script = "errand" }
  s:equal({ driver.config.speed, driver.config.turn_speed }, { 0.1, 1.0 })
  local ahead, left, still = { vx = 0.1, vy = 0, va = 0 }, { vx = 0, vy = 0, va = 1 }, { vx = 0, vy = 0, va = 0 }
  local function at(x, y, heading)
    s:inject("driver.odometry", { position = { x = x, y = y }, heading = heading })
    s:run(0.02)
    return driver.target.value
  end
  local function touch(...)
    s:inject("driver.touch", { ... })
    s:run(0.02)
    return driver.target.value
  end
  local function brakes()
    s:run(0.25)
    s:equal(driver.target.value, still, "until it has braked")
    s:run(0.06)
    return driver.target.value
  end

  s:equal(at(1, 2, 3), ahead)
  s:equal(at(1.11, 2.16, 3), ahead, "19.4 cm from where it began")
  s:equal(at(1.13, 2.16, 3), still, "20.6 cm")
  s:equal(brakes(), left)
  s:equal(at(1.13, 2.16, -3), left, "across the seam at pi")
  s:equal(at(1.13, 2.16, -1.75), left, "1.53 rad from where it began")
  s:equal(at(1.13, 2.16, -1.70), still, "1.58 rad")
  s:equal(brakes(), still)
  s:equal(touch(false, false), still)
  s:equal(touch(false, true), still, "a touch is not over before the sensor is released")
  s:run(0.5)
  s:equal(driver.target.value, still)
  s:equal(touch(false, false), ahead, "and again")
  s:equal(at(1.13, 2.35, -1.70), ahead)
  s:equal(at(1.13, 2.37, -1.70), still, "20 cm from where it went on")
end)

scenario("a search that an obstacle breaks off is taken up again", function(s)
  s:arena { s:box { at = { 0.5, 0, 0.15 }, size = { 0.1, 2, 0.3 } } }
  s:robot "mouse" { model = "raspimouse" }
  s:behavior "searcher" { script = "search" }
  s:connect("mouse.ir_sensor_out", "searcher.near")
  s:connect("searcher.target", "mouse.target_velocity_in")
  s:always("hits nothing", function() return not s.mouse.collided end)
  s:inject("searcher.near", { 0, 0, 0, 0 })
  s:run(2.5)
  s:check(s.searcher.state.rounds == 1)
  s:hold("mouse.ir_sensor_out", { 0, 200, 200, 0 })
  s:run(0.02)
  s:check(s.searcher.tasks.search.status == "cancelled", s.searcher.tasks.search.status)
  s:check(s.mouse.target_velocity_in.value.vx < 0)
  s:release("mouse.ir_sensor_out")
  s:run(1.4)
  s:check(s.searcher.tasks.search.status == "waiting", s.searcher.tasks.search.status)
  s:check(s.mouse.target_velocity_in.value.vx > 0)
  s:run(2)
  s:check(s.searcher.state.rounds == 2)
end)

scenario("a search widens turn by turn, also over an interruption and a reload", { timeout = 20 }, function(s)
  local searcher = s:behavior "searcher" { script = "search" }
  s:equal({ searcher.config.speed, searcher.config.stop_at }, { 0.15, 60 })
  local function drives(vx, va)
    s:near(searcher.target.value.vx, vx, 1e-9)
    s:near(searcher.target.value.va, va, 1e-9)
  end
  s:inject("searcher.near", { 0, 60, 60, 0 })
  s:run(0.02)
  for round = 1, 3 do
    drives(0.15, 1.5 / round)
    s:run(1.95)
    drives(0.15, 1.5 / round)
    s:run(0.06)
  end
  s:equal(searcher.state.rounds, 3)

  for _ = 1, 2 do
    s:inject("searcher.near", { 0, 0, 0, 61 })
    s:run(0.02)
    drives(-0.15, 0)
    s:inject("searcher.near", { 0, 0, 0, 0 })
    s:run(0.46)
    drives(-0.15, 0)
    s:run(0.04)
    drives(0, 2)
    s:run(0.74)
    drives(0, 2)
    s:run(0.06)
    drives(0.15, 1.5 / 4)
    s:equal(searcher.state.rounds, 3, "a round that was broken off does not count")
    s:run(0.5)
  end
  s:run(1.5)
  s:equal(searcher.state.rounds, 4)
  s:check(s:reload("searcher", { file = "search" }))
  s:run(0.02)
  drives(0.15, 1.5 / 5)
  s:inject("searcher.near", { 61 })
  s:run(0.02)
  drives(-0.15, 0)
end)

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

--- The follower by itself: every branch of what it does with a position; then the whole system, from picture to wheels.

local function at(x, y) return { position = { x = x, y = y } } end

local function follower_alone(s, config)
  s:behavior("follower", { script = "marker_follower", config = config })
  local follower = s.follower
  local function told(x, y)
    s:inject("follower.marker_pos", at(x, y))
    s:run(0.03)
    return follower.target_vel.value
  end
  return follower, told
end

scenario("drives to its distance first, then turns to its side", { timeout = 30 }, function(s)
  local _, told = follower_alone(s)
  local function expect(x, y, vx, va)
    local v = told(x, y)
    s:check(v.vx == vx and v.va == va, string.format("at (%g, %g): vx = %g, va = %g", x, y, v.vx, v.va))
  end
  expect(0.56, 0.0, 0.1, 0)
  expect(0.44, 0.0, -0.1, 0)
  expect(0.5, 0.03, 0, 0.2)
  expect(0.5, -0.03, 0, -0.2)
  expect(0.5, 0.0, 0, 0)
  -- Within the band it stands, on either side of its middle.
  expect(0.54, 0.02, 0, 0)
  expect(0.46, -0.02, 0, 0)
  -- Distance comes before turning.
  expect(0.9, 0.5, 0.1, 0)
  expect(0.2, -0.5, -0.1, 0)
end)

scenario("keeps the distance that its configuration says", { timeout = 30 }, function(s)
  local _, told = follower_alone(s, {
    x_distance = 1.0, y_distance = 0.2, x_speed = 0.3, r_speed = 0.5, error_range_x = 0.2, error_range_y = 0.1,
  })
  s:near(told(1.15, 0).vx, 0.3, 0)
  s:near(told(0.85, 0).vx, -0.3, 0)
  s:near(told(1.05, 0.3).va, 0.5, 0)
  s:near(told(1.05, 0.1).va, -0.5, 0)
  local v = told(0.95, 0.2)
  s:check(v.vx == 0 and v.va == 0, "within its bands it stands")
end)

scenario("acts only on new data, and stops once when nothing comes", { timeout = 30 }, function(s)
  local follower, told = follower_alone(s)
  s:run(1)
  s:check(follower.target_vel.age == math.huge, "silent before a marker was seen")
  told(1, 0)
  s:run(0.2)
  s:check(follower.target_vel.age > 0.15, "one position, one command")
  s:check(follower.target_vel.value.vx == 0.1, "on its way")
  s:eventually("stops", { within = 0.2 }, function() return follower.target_vel.value.vx == 0 end)
  s:run(1)
  s:check(follower.target_vel.age > 0.9, "it stops once")
  s:near(told(1, 0).vx, 0.1, 0)
end)

scenario("stops when it is stopped", { timeout = 30 }, function(s)
  local follower, told = follower_alone(s)
  told(1, 0)
  follower:deactivate()
  s:run(0.02)
  s:check(follower.target_vel.value.vx == 0, "a follower that is stopped lets the robot stand")
end)

scenario("follows a marker that is carried along a path", { timeout = 60 }, function(s)
  local world = s:load "systems/follow_marker.lua"
  local x, y = 1.0, 0.0
  -- From the camera, which is 5 cm before the middle of the mouse.
  local function distance()
    local mouse = world.mouse.truth.pose.position
    return math.sqrt((x - mouse.x) ^ 2 + (y - mouse.y) ^ 2) - 0.05
  end
  s:eventually("comes up to it", { within = 10 }, function() return distance() < 0.56 end)
  local function near_enough() return math.abs(distance() - 0.5) < 0.1 end
  s:always("half a metre, give or take 5 cm and half the band", near_enough)
  for i = 1, 300 do
    x, y = x + 0.0025, 0.1 * math.sin(i / 40)
    s:teleport("target", { x = x, y = y })
    s:run(0.05)
  end
  s:run(2)
  s:check(world.mouse.truth.pose.position.x > 1.0, "it has come along")
end)

scenario("stops when the marker disappears, and goes on when it is back", { timeout = 60 }, function(s)
  local world = s:load "systems/follow_marker.lua"
  s:wait_until("under way", { within = 3 }, function() return world.mouse.truth.velocity.vx > 0.09 end)
  s:check(world.detector.visible.value, "the marker is in sight")
  s:teleport("target", { z = -5 })
  s:maintain("stands", { hold = 2, within = 0.5 }, function() return math.abs(world.mouse.truth.velocity.vx) < 0.001 end)
  s:check(not world.detector.visible.value, "the marker is out of sight")
  s:check(world.detector.pos.age > 2, "no position without a marker")
  s:teleport("target", { z = 0.06 })
  s:eventually("goes on", { within = 1 }, function() return world.mouse.truth.velocity.vx > 0.09 end)
end)

scenario("a detector tells all markers in sight, the nearest first", { timeout = 10 }, function(s)
  s:arena {
    s:marker { name = "far", id = 1, size = 0.1, at = { 1.4, 0.2, 0.06 }, facing = math.pi },
    s:marker { name = "near", id = 2, size = 0.1, at = { 0.9, -0.2, 0.06 }, facing = math.pi },
  }
  s:robot "mouse" { model = "raspimouse" }
  s:component "eye" { type = "Camera", on = "mouse", at = { 0.05, 0.0, 0.06 } }
  s:component "detector" { type = "MarkerDetector", config = { tag_size = 0.1 } }
  s:connect("eye.out", "detector.image")
  s:run(0.2)
  local seen = s.detector.markers.value
  s:check(#seen == 2 and seen[1].id == 2 and seen[2].id == 1, "both, the nearest first")
  s:near(seen[2].pose.position.x, 1.35, 0.02)
  s:near(seen[2].pose.position.y, 0.2, 0.02)
  s:teleport("near", { z = -5 })
  s:run(0.2)
  seen = s.detector.markers.value
  s:check(#seen == 1 and seen[1].id == 1, "the one that is left")
  s:check(s.detector.id.value == 1, "which is the nearest now")
  s:teleport("far", { z = -5 })
  s:run(0.2)
  s:check(#s.detector.markers.value == 0, "none")
end)

scenario("an error in a marker's name or pose is reported", { timeout = 10 }, function(s)
  s:load "systems/follow_marker.lua"
  local function told(name, pose, expected)
    local ok, message = pcall(function() s:teleport(name, pose) end)
    s:check(not ok and tostring(message):find(expected, 1, true), tostring(message))
  end
  told("targt", { x = 1 }, "there is no marker 'targt' (did you mean 'target'?)")
  told("mose", { x = 1 }, "there is no component 'mose' (did you mean 'mouse'?)")
  told("target", { hight = 1 }, "pose: unknown field 'hight'")
  told("target", { x = 0 / 0 }, "field 'x'")
  told("target", 5, "pose: expected a table { x =, y =, z =, heading = }, got number")
end)

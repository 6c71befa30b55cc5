--- A port is stale after three periods of its sender, at least 0.1 s, where that declares a rate, after 0.5 s otherwise: both
--- sides of that limit, for each kind of sender.

--- `ports` have just had their last message: they are stale `limit` seconds after it.
local function check_limit(s, limit, ...)
  s:run(0.02) -- what was sent is on its way for a tick
  for _, port in ipairs { ... } do
    s:check(not port.stale, port.path .. " has just had a message")
  end
  s:run(limit - (...).age - 0.01)
  for _, port in ipairs { ... } do
    s:check(not port.stale, ("%s is stale after %.2f s, before its limit of %g s"):format(port.path, port.age, limit))
  end
  s:run(0.04)
  for _, port in ipairs { ... } do
    s:check(port.stale, ("%s is not stale after %.2f s, beyond its limit of %g s"):format(port.path, port.age, limit))
  end
end

scenario("a behaviour's port is stale by the behaviour's rate, before and after a reload", {
  sweep = { rate = { 0, 5, 50 } },
}, function(s, p)
  local limit = ({ [0] = 0.5, [5] = 0.6, [50] = 0.1 })[p.rate]
  local sender = s:behavior("sender", { script = "sends_on_demand", rate = p.rate > 0 and p.rate or nil })
  local listener = s:behavior("listener", { script = "sends_on_demand", config = { sends = false } })
  s:connect("sender.out", "listener.in")
  s:check(sender.out.stale and listener.ports["in"].stale, "nothing has come yet")

  local function send_for_a_second()
    sender.config.sends = true
    s:run(1)
    sender.config.sends = false
  end
  send_for_a_second()
  check_limit(s, limit, sender.out, listener.ports["in"])

  local ok, message = s:reload("sender", { text = [[
input("in", "TimedLong", "what others send")
local out, other = output("out", "TimedLong"), output("other", "TimedLong")
param("sends", true)
function on_execute()
  if config.sends then out:write(1) other:write(2) end
end]] })
  s:check(ok, message)
  send_for_a_second()
  check_limit(s, limit, sender.out, sender.other, listener.ports["in"])
end)

scenario("a robot's port that has a rate is stale by it", {
  sweep = { rate = { 4, 50 }, port = { "current_pose_out", "current_velocity_out", "ir_sensor_out", "ir_sensor_metre_out" } },
}, function(s, p)
  local mouse = s:robot("mouse", { model = "raspimouse", ports = { [p.port] = { rate = p.rate } } })
  s:run(1)
  s:drop(mouse[p.port])
  check_limit(s, ({ [4] = 0.75, [50] = 0.1 })[p.rate], mouse[p.port])
end)

scenario("a robot's port without a rate is stale after half a second", function(s)
  local mouse = s:robot("mouse", { model = "raspimouse" })
  s:run(1)
  s:drop(mouse.ir_sensor_out)
  check_limit(s, 0.5, mouse.ir_sensor_out)
end)

scenario("a camera's picture is stale by its frame rate, and by another that it is given", function(s)
  s:robot("mouse", { model = "raspimouse" })
  local pictures = { frame_rate = 4.0, latency = 0.0, width = 32, height = 24 }
  local camera = s:component("camera", { type = "Camera", on = "mouse", config = pictures })
  s:run(1)
  camera:deactivate()
  check_limit(s, 0.75, camera.out)
  camera.config.frame_rate = 2.0
  camera:activate()
  s:run(1)
  camera:deactivate()
  check_limit(s, 1.5, camera.out)
end)

--- Follows the left edge of a dark line on a light floor: a PID controller keeps the sensor half over it.
--- On the line's right it takes the floor for that on the left, and turns away from the line: a push across it loses it.

local pid = require "nezumi.pid"

local light  = input("light", "TimedDouble", "light that the floor reflects: 0 (black) to 100 (white)")
local target = output("target", "TimedVelocity2D", "target velocity")

param("speed", 0.15, { min = 0.0, max = 0.3, step = 0.01, widget = "slider", unit = "m/s", doc = "along the line" })
param("edge", 50.0, { min = 0.0, max = 100.0, doc = "light at full deflection: the mean of line and floor" })
param("kp", 0.03, { min = 0.0, unit = "rad/s", doc = "proportional gain, for each unit of light" })
param("kd", 0.001, { min = 0.0, unit = "rad", doc = "derivative gain" })

state.keep = state.keep or {}
local keep = pid({ min = -2, max = 2, derivative_time = 0.03 }, state.keep)

function on_execute()
  if light.tm == 0 then return end
  keep.kp, keep.kd = config.kp, config.kd
  -- Too light is left of the edge: to the right, which is a negative rate.
  target:write { vx = config.speed, va = keep:update(config.edge, light:read(), dt) }
end

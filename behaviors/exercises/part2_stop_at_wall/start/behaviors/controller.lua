--- Drives at the configured speed. To do: stop in front of an obstacle.

local range  = input("in", "TimedShortSeq", "distance sensors; a larger value is nearer")
local target = output("out", "TimedVelocity2D", "target velocity")

param("speed_x", 0.0, { min = 0, max = 0.3, step = 0.01, widget = "slider", unit = "m/s", doc = "straight-ahead speed" })
param("stop_d", 30, { doc = "stop when a sensor value exceeds this" })

function on_execute()
  local values = range:read()  -- four numbers: values[1] to values[4]; none before the first message
  target:write { vx = config.speed_x }
end

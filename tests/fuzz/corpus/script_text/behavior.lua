--- Drives at the configured speed and stops in front of an obstacle.

local range  = input("in", "TimedShortSeq", "distance sensors; a larger value is nearer")
local target = output("out", "TimedVelocity2D", "target velocity")

param("speed_x", 0.0, { min = -1.5, max = 1.5, step = 0.01, widget = "slider", unit = "m/s", doc = "straight-ahead speed" })
param("speed_r", 0.0, { min = -2.0, max = 2.0, step = 0.01, widget = "slider", unit = "rad/s", doc = "rotational speed" })
param("stop_d", 30, { doc = "stop when a sensor value exceeds this" })

local function blocked()
  for _, value in ipairs(range:read()) do
    if value > config.stop_d then return true end
  end
  return false
end

function on_execute()
  if config.speed_x > 0 and blocked() then
    target:write { vx = 0, va = 0 }
  else
    target:write { vx = config.speed_x, va = config.speed_r }
  end
end

function on_deactivated()
  target:write { vx = 0, va = 0 }
end

--- Two touch sensors drive a robot. To do: the left sensor, and no sensor.

local touch  = input("touch", "TimedBooleanSeq", "touch sensors: right, left")
local target = output("target_velocity", "TimedVelocity2D", "target velocity")

param("speed", 0.2, { min = 0, max = 0.3, unit = "m/s", doc = "speed of driving forward and backward" })

function on_execute()
  local pressed = touch:read()
  if pressed[1] then
    target:write { vx = config.speed }
  end
end

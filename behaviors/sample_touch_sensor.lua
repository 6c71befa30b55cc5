--- Two touch sensors drive a robot: the right one forward, the left one backward, neither stops it.

local touch  = input("touch", "TimedBooleanSeq", "touch sensors: right, left")
local target = output("target_velocity", "TimedVelocity2D", "target velocity")

param("speed", 0.2, { unit = "m/s", doc = "speed of driving forward and backward" })

function on_execute()
  if not touch.is_new then return end
  local pressed = touch:read()
  if #pressed ~= 2 then return end
  if pressed[1] then
    target:write { vx = config.speed }
  elseif pressed[2] then
    target:write { vx = -config.speed }
  else
    target:write { vx = 0 }
  end
end

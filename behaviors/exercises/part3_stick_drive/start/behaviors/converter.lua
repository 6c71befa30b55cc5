--- Makes a velocity of a joystick's position. To do: all of it.

local stick  = input("in", "TimedFloatSeq", "the stick's position { x, y }, from its middle; y up")
local target = output("out", "TimedVelocity2D", "target velocity")

param("speed_by_y", 0.002, { doc = "speed [m/s] for each unit of y" })
param("turn_by_x", 0.02, { doc = "yaw rate [rad/s] for each unit of x" })

function on_execute()
  if not stick.is_new then return end
  local position = stick:read()  -- position[1] is x, position[2] is y
  target:write { vx = 0, va = 0 }
end

--- Makes a velocity of a joystick's place: up and down drives, left and right turns.

local stick  = input("in", "TimedFloatSeq", "the stick's place { x, y }, from its middle; y up")
local target = output("out", "TimedVelocity2D", "target velocity")

param("rotation_by_position", -0.02, { doc = "yaw rate [rad/s] for each unit of x" })
param("velocity_by_position", 0.002, { doc = "speed [m/s] for each unit of y" })

function on_execute()
  if not stick.is_new then return end
  local place = stick:read()
  if #place < 2 then return end
  target:write { vx = place[2] * config.velocity_by_position, va = place[1] * config.rotation_by_position }
end

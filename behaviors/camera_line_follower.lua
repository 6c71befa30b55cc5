--- Follows a line that its camera sees: steers by how far beside the middle it is, and by which way it runs.

local offset = input("offset", "TimedDouble", "where the line is in the picture: 1 at its left edge, -1 at its right one")
local angle  = input("angle", "TimedDouble", "[rad] which way it runs: 0 straight ahead, positive to the left")
local target = output("target", "TimedVelocity2D", "target velocity")

param("speed", 0.15, { min = 0.0, max = 0.5, step = 0.01, widget = "slider", unit = "m/s", doc = "along the line" })
param("k_offset", 7.0, { min = 0.0, unit = "rad/m", doc = "how sharply to turn to a line at the picture's edge" })
param("k_angle", 2.5, { min = 0.0, unit = "1/m", doc = "how sharply to turn for each radian of the line's angle" })
param("lost_after", 0.3, { min = 0.0, unit = "s", doc = "stop when no line was seen for so long" })

-- Whether the last command may have been to move.
local moving = false

local function drive(vx, va)
  target:write { vx = vx, va = va }
  moving = vx ~= 0 or va ~= 0
end

function on_execute()
  if offset.is_new then
    -- By the metre, not by the second: the way is the same at any speed.
    local curvature = config.k_offset * offset:read() + config.k_angle * angle:read()
    drive(config.speed, config.speed * curvature)
  elseif moving and offset.age > config.lost_after then
    drive(0, 0)
  end
end

--- Keeps a marker at a distance, straight ahead: drives first, then turns. Stops when the marker is out of sight.

local marker = input("marker_pos", "TimedPose3D", "where the marker is: x forward, y left")
local target = output("target_vel", "TimedVelocity2D", "target velocity")

param("x_distance", 0.5, { unit = "m", doc = "distance to keep" })
param("y_distance", 0.0, { unit = "m", doc = "how far to the left to keep it" })
param("x_speed", 0.1, { min = 0.0, unit = "m/s", doc = "speed of approaching and backing away" })
param("r_speed", 0.2, { min = 0.0, unit = "rad/s", doc = "speed of turning" })
param("error_range_x", 0.1, { min = 0.0, unit = "m", doc = "width of the band of distances that are near enough" })
param("error_range_y", 0.05, { min = 0.0, unit = "m", doc = "width of the band in which it counts as straight ahead" })
param("lost_after", 0.3, { min = 0.0, unit = "s", doc = "stop when nothing was seen for so long; 0: never" })

-- Whether the last command may have been to move.
local moving = false

local function drive(vx, va)
  target:write { vx = vx, va = va }
  moving = vx ~= 0 or va ~= 0
end

local function follow(x, y)
  if x > config.x_distance + config.error_range_x / 2 then
    drive(config.x_speed, 0)
  elseif x < config.x_distance - config.error_range_x / 2 then
    drive(-config.x_speed, 0)
  elseif y > config.y_distance + config.error_range_y / 2 then
    drive(0, config.r_speed)
  elseif y < config.y_distance - config.error_range_y / 2 then
    drive(0, -config.r_speed)
  else
    drive(0, 0)
  end
end

function on_execute()
  if marker.is_new then
    local position = marker:read().position
    follow(position.x, position.y)
  elseif moving and config.lost_after > 0 and marker.age > config.lost_after then
    drive(0, 0)
  end
end

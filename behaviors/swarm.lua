--- Wanders, and turns away from what is near: a swarm of these spreads out and never bunches up.

local rays = input("rays", "TimedDoubleSeq", "24 proximity sensors around the robot, left first; a larger value is nearer")
local out  = output("out", "TimedVelocity2D", "target velocity")

param("speed", 0.05, { min = 0.0, max = 1.0, unit = "m/s", doc = "speed of a wheel" })
param("track", 0.14, { min = 0.001, unit = "m", doc = "distance between the wheels" })

local near    = 0.1               -- a mean reading below it lets the robot go straight on
local ahead   = math.rad(7.5)     -- and so does an obstacle no farther than this from straight ahead
local COUNT   = 24
local cosines = {}
local sines   = {}
for i = 1, COUNT do
  local angle = math.rad(7.5 + 15 * (i - 1))
  cosines[i], sines[i] = math.cos(angle) / COUNT, math.sin(angle) / COUNT
end

local velocity = {}

local function drive(vx, va)
  velocity.vx, velocity.va = vx, va
  out:write(velocity)
end

function on_execute()
  local x, y = 0.0, 0.0
  for i, value in ipairs(rays:read()) do
    if value ~= 0 then
      x, y = x + value * cosines[i], y + value * sines[i]
    end
  end
  local angle, speed = math.atan(y, x), config.speed
  if math.abs(angle) <= ahead and x * x + y * y < near * near then
    drive(speed, 0)
  elseif angle > 0 then
    drive(speed / 2, -speed / config.track)
  else
    drive(speed / 2, speed / config.track)
  end
end

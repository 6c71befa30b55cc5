--- Follows the wall on its left: a PID controller keeps the distance, and what is ahead makes it turn right.

local filters = require "nezumi.filters"
local pid = require "nezumi.pid"

local ranges = input("ranges", "TimedDoubleSeq", "distances [m]: right front, right side, left side, left front")
local target = output("target", "TimedVelocity2D", "target velocity")

param("speed", 0.15, { min = 0.0, max = 0.3, step = 0.01, widget = "slider", unit = "m/s", doc = "along the wall" })
param("distance", 0.12, { min = 0.08, max = 0.3, unit = "m", doc = "to keep, along the beam that looks to the left" })
param("turn_at", 0.12, { min = 0.05, max = 0.5, unit = "m", doc = "turns right with something so near ahead" })
param("kp", 12.0, { min = 0.0, unit = "rad/s/m", doc = "proportional gain" })
param("kd", 1.5, { min = 0.0, unit = "rad/m", doc = "derivative gain" })

local TURN  = 2.0  -- rad/s at most
local ROUND = 0.25 -- radius on which it goes round the end of a wall [m]

state.keep, state.side = state.keep or {}, state.side or {}
local keep = pid({ max = TURN, derivative_time = 0.05 }, state.keep)
local side = filters.median({ count = 3 }, state.side)

function on_execute()
  local seen = ranges:read()
  if #seen < 4 then return end
  keep.kp, keep.kd, keep.min = config.kp, config.kd, -config.speed / ROUND
  local distance = side:update(seen[3])
  probe("error", config.distance - distance)
  -- Nearer than asked for gives an output above 0: to the right, which is a negative rate.
  local rate = -keep:update(config.distance, distance, dt)
  if math.min(seen[1], seen[4]) < config.turn_at then
    target:write { va = -TURN }
  else
    target:write { vx = config.speed, va = rate }
  end
end

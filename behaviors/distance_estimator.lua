--- Estimates distance and speed from noisy distances alone: a Kalman filter for a target of constant speed.

local matrix = require "nezumi.matrix"

local seen     = input("seen", "TimedDoubleSeq", "distances [m]; the first and the last look ahead")
local estimate = output("estimate", "TimedDoubleSeq", "distance [m], speed [m/s]")

param("deviation", 0.01, { min = 1e-6, unit = "m", doc = "of a measured distance" })
param("acceleration", 1.0, { min = 1e-6, unit = "m/s^2", doc = "that the target may have" })

local x = matrix(state.x or { { 0 }, { 0 } })
local p = matrix(state.p or { { 1, 0 }, { 0, 1 } })
local h = matrix { { 1, 0 } }

function on_execute()
  local ranges = seen:read()
  if #ranges == 0 then return end
  local f = matrix { { 1, dt }, { 0, 1 } }
  local g = matrix { { dt * dt / 2 }, { dt } }
  x, p = f * x, f * p * f:transpose() + config.acceleration ^ 2 * (g * g:transpose())
  local s = h * p * h:transpose() + matrix { { config.deviation ^ 2 } }
  local gain = s:solve(h * p):transpose()
  x = x + gain * (matrix { { math.min(ranges[1], ranges[#ranges]) } } - h * x)
  p = (matrix.identity(2) - gain * h) * p
  state.x, state.p = x, p
  estimate:write { x[1][1], x[2][1] }
end

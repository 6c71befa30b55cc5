--- Angles in radians: wrapped into one turn, compared and averaged across the seam at pi.

local expect = require "nezumi.expect"

local angles = {}

local TURN = 2 * math.pi

local function wrap(angle)
  local wrapped = angle % TURN
  return wrapped > math.pi and wrapped - TURN or wrapped
end

--- The same direction as an angle above -pi, up to pi.
---@param angle number [rad]
---@return number [rad]
function angles.wrap(angle)
  expect.number("angles.wrap: angle", angle)
  return wrap(angle)
end

--- How far to turn from one direction to another: above -pi, up to pi; counter-clockwise is positive.
---@param from number [rad]
---@param to number [rad]
---@return number [rad]
function angles.difference(from, to)
  expect.number("angles.difference: from", from)
  expect.number("angles.difference: to", to)
  return wrap(to - from)
end

--- The mean direction: that of the sum of unit vectors. Nil where these cancel out, as those of 0 and pi do.
---@param list number[] [rad], at least one
---@return number? [rad], above -pi, up to pi
function angles.mean(list)
  expect.kind("angles.mean: list", list, "table")
  expect.whole("angles.mean: the length of the list", #list, 1, math.maxinteger)
  local x, y = 0, 0
  for i = 1, #list do
    expect.number("angles.mean: angle " .. i, list[i])
    x, y = x + math.cos(list[i]), y + math.sin(list[i])
  end
  if x * x + y * y < (1e-9 * #list) ^ 2 then return nil end
  return wrap(math.atan(y, x))
end

return angles

-- The margin of a condition in one sample, worked by hand: the robustness of signal temporal logic, and the comparison
-- that decided.

--- The margin of an order is the distance of its sides, negative when it does not hold.
local a = 0.25
return function() return a < 0.5 end  -- returns: 0.25 (a < 0.5)

local a = 0.75
return function() return a < 0.5 end  -- returns: -0.25 (a < 0.5)

local a = 3
return function() return a > 1 end  -- returns: 2 (a > 1)

local a, b = 3, 8
return function() return a >= b end  -- returns: -5 (a >= b)

local pose = { x = 0.5 }
return function() return pose.x < 0.5 end  -- returns: 0 m (pose.x < 0.5)

local pose = { x = 0.5 }
return function() return pose.x <= 0.5 end  -- returns: 0 m (pose.x <= 0.5)

--- An equality is 0 where it holds, and below 0 by the difference where it does not.
local a = 2
return function() return a == 2 end  -- returns: 0 (a == 2)

local a = 2.5
return function() return a == 2 end  -- returns: -0.5 (a == 2)

local a = 2.5
return function() return a ~= 2 end  -- returns: 0.5 (a ~= 2)

local a = 2
return function() return a ~= 2 end  -- returns: 0 (a ~= 2)

--- `and` has the least margin, `or` the greatest, `not` the negative one.
local a, b = 1, 5
return function() return a < 4 and b < 7 end  -- returns: 2 (b < 7)

local a, b = 1, 5
return function() return a < 4 and b < 3 end  -- returns: -2 (b < 3)

local a, b = 5, 9
return function() return a < 4 or b < 7 end  -- returns: -1 (a < 4)

local a, b = 5, 2
return function() return a < 4 or b < 7 end  -- returns: 5 (b < 7)

local a = 1
return function() return not (a < 4) end  -- returns: -3 (a < 4)

local a, b = 1, 5
return function() return not (a > 4 or b > 7) end  -- returns: 2 (b > 7)

local a, b, c = 1, 5, 10
return function() return a < 4 and (b > 7 or c > 9.5) end  -- returns: 0.5 (c > 9.5)

--- Parts that Lua does not evaluate do not count.
local a, b = 6, 100
return function() return a < 4 and b < 7 end  -- returns: -2 (a < 4)

local a, b = 1, -100
return function() return a < 4 or b < 7 end  -- returns: 3 (a < 4)

local a, calls = 1, 0
local function b() calls = calls + 1 return 2 end
return function() return a < 4 or b() < 7 or calls > 0 end  -- returns: 3 (a < 4)

--- A boolean alone has no margin. Beside a comparison it only decides when it differs.
local collided = false
return function() return not collided end  -- returns: none: collided is true or false

local mode = "drive"
return function() return mode == "rest" end  -- returns: none: mode == "rest": does not compare numbers

return function() return true end  -- returns: none: the condition returns a constant

local a, collided = 1, false
return function() return a < 4 and not collided end  -- returns: 3 (a < 4)

local a, collided = 1, true
return function() return a < 4 and not collided end  -- returns: none: collided is true or false

local a, collided = 6, false
return function() return collided or a < 4 end  -- returns: -2 (a < 4)

local a = 0 / 0
return function() return a < 4 end  -- returns: none: a < 4: the difference of its two sides is not finite

--- A helper function has the margin of its own comparisons.
local a, b = 1, 5
local function near() return a < 4 end
return function() return near() and b < 20 end  -- returns: 3 (a < 4)

local function near(value, limit) return value < limit end
return function() return not near(6, 4) and not near(9, 4) end  -- returns: 2 (value < limit)

local lib = { near = function(value) return value < 4 end }
return function() return lib.near(1) end  -- returns: 3 (value < 4)

local function inner(x) return x > 2 end
local function outer(x) return inner(x) and x < 10 end
return function() return outer(3) end  -- returns: 1 (x > 2)

local function near(...) return (...) < 4 end
return function() return near(1, 2) end  -- returns: 3 ((...) < 4)

local function near() return 1 < 4 end
return near  -- returns: 3 (1 < 4)

--- An early return: the comparison that decided, or would have decided otherwise.
local seen, gap = 2, 0.5
return function()
  if seen < 5 then return false end
  return gap < 1
end  -- returns: -3 (seen < 5)

local seen, gap = 8, 0.5
return function()
  if seen < 5 then return false end
  return gap < 1
end  -- returns: 0.5 (gap < 1)

local seen, gap = 5.25, 0.5
return function()
  if seen < 5 then return false end
  return gap < 1
end  -- returns: 0.25 (seen < 5)

-- Both ways return false: the first comparison could not have changed that.
local seen, gap = 5.25, 3
return function()
  if seen < 5 then return false end
  return gap < 1
end  -- returns: -2 (gap < 1)

local seen, gap = 2, 0.5
return function()
  if seen < 5 then return true end
  return gap < 1
end  -- returns: 3 (seen < 5)

local a, b, c = 1, 2, 9
return function()
  if a > 5 then
    return b > 0
  elseif a < 3 then
    return c > 4
  end
  return false
end  -- returns: 2 (a < 3)

--- A loop with a return is `or`, or `and`, of its comparisons.
local gaps = { 0.5, 0.25, 0.75 }
return function()
  for _, gap in ipairs(gaps) do
    if gap < 0.125 then return false end
  end
  return true
end  -- returns: 0.125 (gap < 0.125)

local gaps = { 0.5, 0.0625, 0.75 }
return function()
  for _, gap in ipairs(gaps) do
    if gap < 0.125 then return true end
  end
  return false
end  -- returns: 0.0625 (gap < 0.125)

local gaps = { 0.5, 0.25, 0.75 }
local function any(list)
  for _, gap in ipairs(list) do
    if gap < 0.125 and gap > 0 then return true end
  end
end
return function() return not any(gaps) end  -- returns: 0.125 (gap < 0.125)

--- A local that is set once stands for its comparison.
local a, b = 1, 5
return function()
  local near, low = a < 4, b < 3
  return near and not low
end  -- returns: 2 (b < 3)

-- This one is set again.
local a = 1
return function()
  local near = a < 4
  near = true
  return near
end  -- returns: none: near is true or false

--- Constants of the file are known.
local limit <const> = 4
local low <const> = -2
return function() return 1 < limit and 1 > low end  -- returns: 3 (1 < limit)

--- A condition whose source text can't be found has no margin.
local f, g = function() return 1 < 4 end, function() return 2 < 4 end
return g  -- returns: none: several functions begin on the line of the condition

return function(...) return select("#", ...) > 0, "more" end  -- returns: 0 (select("#", ...) > 0)

--- Results and errors are those of the original.
local function nothing() end
return function() return nothing() or nil, 1 end  -- returns: none: nothing() is true or false

local function fails() error("no") end  -- error: no
return function() return fails() end

local near
return function() return near(1) end  -- error: attempt to call a nil value (upvalue 'near')

return function() return string.no(1) end  -- error: attempt to call a nil value (field 'no')

local function fails() error("no") end
return function() return pcall(fails) and 1 < 2 or 3 < 4 end  -- returns: 1 (3 < 4)

-- A function that calls itself is followed once.
local function deep(n) return n > 3 or deep(n + 1) end
return function() return deep(1) end  -- returns: none: deep(n + 1) is true or false

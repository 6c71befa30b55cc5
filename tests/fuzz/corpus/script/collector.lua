-- A weak table made so after setmetatable has looked, with a chain of keys that the collector follows link by link.
input("in", "TimedShortSeq")
output("out", "TimedVelocity2D")
local m = {}
local t = setmetatable({}, m)
local first
function on_execute()
  local keys = {}
  for i = 1, 5000 do keys[i] = {} end
  for i = 1, 4999 do t[keys[i]] = keys[i + 1] end
  first = keys[1]
  keys = nil
  m.__mode = "k"
  local junk
  for _ = 1, 1000 do junk = { first, t, junk } end
end

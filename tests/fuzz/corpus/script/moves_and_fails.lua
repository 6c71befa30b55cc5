-- Full speed, and then every way to stop being in charge of it.
input("in", "TimedShortSeq")
local out = output("out", "TimedVelocity2D")
local n = 0
function on_execute()
  n = n + 1
  out:write { vx = 0.3 }
  if n == 15 then error(setmetatable({}, { __tostring = function() error(nil) end })) end
end
function on_aborting() out:write { vx = 0.3 } end
function on_error() out:write { vx = 0.3 } end

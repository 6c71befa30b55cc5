-- As much as there is, again and again.
input("in", "TimedShortSeq")
output("out", "TimedVelocity2D")
local kept = {}
function on_execute()
  for i = 1, 1000 do pcall(function() kept[#kept + 1] = ("x"):rep(1 << 24) end) end
  error(kept)
end

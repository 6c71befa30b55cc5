-- Variables that are closed on the way out of a loop without end, each with another.
input("in", "TimedShortSeq")
output("out", "TimedVelocity2D")
function on_execute()
  local function again() local t <close> = setmetatable({}, { __close = again }) while true do end end
  pcall(again)
end

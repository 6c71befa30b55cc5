-- Where Lua can't yield: in a pattern's replacement, in a comparison, in a message handler.
input("in", "TimedShortSeq")
output("out", "TimedVelocity2D")
function on_execute()
  pcall(string.gsub, "x", ".", function() while true do end end)
  pcall(table.sort, { 1, 2 }, function() while true do end end)
  xpcall(error, function() while true do end end)
end
function on_aborting() while true do end end
function on_error() while true do end end

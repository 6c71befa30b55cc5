local near = input("in", "TimedShortSeq", "", { queue = 2 })
local out = output("out", "TimedVelocity2D", "", { safe = { vx = 0 } })
param("gains", { 1.0, 0.5 }, { min = 0.0, max_size = 3 })
about { version = "1.0", vendor = "any" }
command("go", function(a) return a end, "goes")
task("patrol", function()
  wait(0.5)
  local seen = wait_until(function() return near:read()[1] > 30 end, { within = 5 })
  probe("seen", seen)
end, { repeating = true })
function on_reload(old_version) state.n = old_version start("patrol") cancel("patrol") end

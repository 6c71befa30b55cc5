--- Searches a room in ever wider turns. An obstacle breaks the search off; when the robot has backed away, it is taken up again.
--- It backs away blindly, for half a second at its speed: a wall that is nearer behind it is touched.

local near   = input("near", "TimedShortSeq", "distance sensors; a larger value is nearer")
local target = output("target", "TimedVelocity2D", "target velocity")

param("speed", 0.15, { min = 0.0, max = 0.5, unit = "m/s", doc = "speed of searching" })
param("stop_at", 60, { doc = "backs away when a sensor value exceeds this" })

state.rounds = state.rounds or 0 -- of the search, over interruptions and reloads

local command = {}

local function is_blocked()
  for _, value in ipairs(near:read()) do
    if value > config.stop_at then return true end
  end
  return false
end

task("search", function()
  while true do
    command = { vx = config.speed, va = 1.5 / (1 + state.rounds) }
    wait(2)
    state.rounds = state.rounds + 1
  end
end)

task("watch", function()
  wait_until(is_blocked)
  cancel("search")
  command = { vx = -config.speed }
  wait(0.5)
  command = { va = 2 }
  wait(0.8)
  start("search")
end, { repeating = true })

function on_execute()
  target:write(command)
end

--- Sends until it is told not to.

input("in", "TimedLong", "what others send")
local out = output("out", "TimedLong", "how often it was executed")

param("sends", true, { doc = "whether it sends" })

local count = 0

function on_execute()
  count = count + 1
  if config.sends then out:write(count) end
end

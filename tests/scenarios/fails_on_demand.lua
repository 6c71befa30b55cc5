--- Drives forward, and fails or never ends when it is told to.

local target = output("out", "TimedVelocity2D", "target velocity")

param("speed", 0.2, { doc = "forward speed [m/s]" })
param("fail", false, { doc = "raise an error in the next execution" })

function on_execute()
  target:write { vx = config.speed }
  if config.fail then error("as demanded") end
end

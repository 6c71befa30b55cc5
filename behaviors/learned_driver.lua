--- Drives by weights that a program has learned (learn.py writes them).

local policy = require "linear_policy"

local ranges = input("ranges", "TimedDoubleSeq", "distances [m]: right front, right side, left side, left front")
local target = output("target", "TimedVelocity2D", "target velocity")

param("weights", { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, { doc = "two rows of the policy: forward, turn" })

function on_execute()
  local seen = ranges:read()
  if #seen < policy.SENSORS then return end
  target:write(policy.velocity(policy.act(config.weights, policy.features(seen))))
end

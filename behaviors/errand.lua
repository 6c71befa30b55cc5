--- Runs an errand step by step: 20 cm ahead, a quarter turn to the left, then waits for a touch, and does it again.
--- It brakes at the end of each step, so it goes a little farther: at 0.5 m/s 26 cm.

local odometry = input("odometry", "TimedPose2D", "where the robot reckons to be")
local touch    = input("touch", "TimedBooleanSeq", "touch sensors; any of them will do")
local target   = output("target", "TimedVelocity2D", "target velocity")

param("speed", 0.1, { min = 0.01, max = 0.5, unit = "m/s", doc = "straight-ahead speed" })
param("turn_speed", 1.0, { min = 0.1, max = 3.0, unit = "rad/s", doc = "speed of turning" })

local command = {}

local function stand_still()
  command = {}
  wait(0.3) -- until it has braked
end

local function forward(distance)
  local from = odometry:read().position
  command = { vx = config.speed }
  wait_until(function()
    local at = odometry:read().position
    return (at.x - from.x) ^ 2 + (at.y - from.y) ^ 2 >= distance ^ 2
  end)
  stand_still()
end

local function turn(angle)
  local turned, last = 0, odometry:read().heading
  command = { va = config.turn_speed }
  wait_until(function()
    local heading = odometry:read().heading
    local change = heading - last
    turned, last = turned + math.atan(math.sin(change), math.cos(change)), heading
    return turned >= angle
  end)
  stand_still()
end

local function is_touched()
  for _, pressed in ipairs(touch:read()) do
    if pressed then return true end
  end
  return false
end

task("errand", function()
  forward(0.2)
  turn(math.pi / 2)
  wait_until(is_touched)
  wait_until(function() return not is_touched() end)
end, { repeating = true })

function on_execute()
  target:write(command)
end

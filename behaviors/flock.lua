--- One of a flock: keeps off its neighbours, goes where they go, and stays with them (Reynolds, SIGGRAPH 1987).

local poses = require "nezumi.poses"

local pose   = input("pose", "TimedPose2D", "odometry")
local others = input("others", "NeighbourSeq", "the robots in sight; each says its heading [rad]")
local ranges = input("ranges", "TimedDoubleSeq", "distances [m]; the first and the last look ahead")
local say    = output("say", "TimedDoubleSeq", "this robot's heading [rad]: for the others")
local target = output("target", "TimedVelocity2D", "target velocity")

param("initial", { 0.0, 0.0, 0.0 }, { min_size = 3, max_size = 3, doc = "where it was set down: x [m], y [m], heading [rad]" })
param("speed", 0.12, { min = 0.0, max = 0.3, step = 0.01, widget = "slider", unit = "m/s", doc = "when all is well" })
param("apart", 0.3, { min = 0.1, unit = "m", doc = "how far to keep off the others" })
param("separation", 8.0, { min = 0.0, doc = "weight of keeping off" })
param("alignment", 1.0, { min = 0.0, doc = "weight of going where the others go" })
param("cohesion", 0.5, { min = 0.0, doc = "weight of staying together" })
param("home", 1.8, { min = 0.1, unit = "m", doc = "radius around the origin that the flock turns back to" })

local NEAR = 0.08 -- something so near ahead is in the way [m]

--- The sum of what neighbours and home say, as a vector in the robot's own frame.
local function wish(here)
  local sum = { x = 0, y = 0 }
  local function add(weight, bearing)
    sum.x, sum.y = sum.x + weight * math.cos(bearing), sum.y + weight * math.sin(bearing)
  end
  for _, other in ipairs(others:read()) do
    add(-config.separation * math.max(0, config.apart / math.max(0.01, other.range) - 1), other.bearing)
    add(config.cohesion * other.range, other.bearing)
    local heading = other.message[1]
    if heading then add(config.alignment, heading - here.heading) end
  end
  local at = here.position
  local far = math.sqrt(at.x ^ 2 + at.y ^ 2) - config.home
  if far > 0 then add(100 * far, math.atan(-at.y, -at.x) - here.heading) end
  return sum
end

function on_execute()
  local here = poses.compose(poses.plane(table.unpack(config.initial)), pose:read())
  local seen = ranges:read()
  say:write { here.heading }
  local sum = wish(here)
  local bearing = math.atan(sum.y, sum.x)
  local blocked = #seen > 0 and math.min(seen[1], seen[#seen]) < NEAR
  target:write {
    vx = blocked and 0 or config.speed * math.max(0, math.cos(bearing)),
    va = math.max(-2, math.min(2, 3 * bearing)),
  }
end

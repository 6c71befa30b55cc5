--- Finds its way to a goal through a place it has never seen: it maps what its sensors see, and plans again as it learns.

local angles = require "nezumi.angles"
local grid = require "nezumi.grid"
local path = require "nezumi.path"
local poses = require "nezumi.poses"

local pose   = input("pose", "TimedPose2D", "where the robot is")
local ranges = input("ranges", "TimedDoubleSeq", "distances [m]: right front, right side, left side, left front")
local target = output("target", "TimedVelocity2D", "target velocity")
local plan   = output("plan", "TimedDoubleSeq", "corners of the way [m]: x, y, x, y ...")

param("goal", { 1.0, 0.0 }, { min_size = 2, max_size = 2, unit = "m", doc = "x and y, less than 1.5: the map ends there" })
param("speed", 0.15, { min = 0.01, max = 0.3, step = 0.01, widget = "slider", unit = "m/s", doc = "at most" })
param("clearance", 0.1, { min = 0.0, unit = "m", doc = "from the robot's middle to what it keeps off" })

local SIDE, CELL = 3.0, 0.05 -- of the map and its cells [m]
local REACH = 0.55           -- a sensor that says more sees nothing [m]
local EVERY = 0.3            -- time from plan to plan [s]

--- The beams as seen from the robot, in the order of `ranges`.
local beams = {
  poses.plane(0.035, -0.040, 0),
  poses.plane(0.045, -0.030, -math.pi / 4),
  poses.plane(0.045, 0.030, math.pi / 4),
  poses.plane(0.035, 0.040, 0),
}

state.map = state.map or {}
local cells = math.floor(SIDE / CELL)
local map = grid({ columns = cells, rows = cells, cell = CELL, x = -SIDE / 2, y = -SIDE / 2 }, state.map)
local way, planned

--- Draws what the beams see into the map.
local function look(here)
  for i, distance in ipairs(ranges:read()) do
    local beam = poses.compose(here, beams[i])
    local hit = distance < REACH
    local tip = poses.transform(beam, { x = hit and distance or REACH, y = 0 })
    map:mark_ray(beam.position.x, beam.position.y, tip.x, tip.y, hit)
  end
end

function on_execute()
  local here = pose:read()
  look(here)
  if not planned or now() >= planned + EVERY then
    planned = now()
    way = path.find(map, here.position, { x = config.goal[1], y = config.goal[2] }, { clearance = config.clearance })
    local corners = {}
    for _, point in ipairs(way or {}) do
      corners[#corners + 1] = point.x
      corners[#corners + 1] = point.y
    end
    plan:write(corners)
  end
  if not way then return target:write { va = 1 } end -- looks round: what it takes for a wall may be none
  local left = path.length { here.position, { x = config.goal[1], y = config.goal[2] } }
  if left < 0.03 then return target:write {} end
  local ahead = path.ahead(way, here.position, 0.1)
  local bearing = angles.wrap(math.atan(ahead.y - here.position.y, ahead.x - here.position.x) - here.heading)
  local speed = math.abs(bearing) < math.pi / 4 and math.min(config.speed, left) or 0
  target:write { vx = speed * math.cos(bearing), va = math.max(-2, math.min(2, 4 * bearing)) }
end

--- Drives to a goal by odometry: turns towards it, drives there, and turns to the heading that is asked for.

local angles = require "nezumi.angles"
local pid = require "nezumi.pid"
local poses = require "nezumi.poses"
local state_machine = require "nezumi.state_machine"

local pose   = input("pose", "TimedPose2D", "where the robot is")
local target = output("target", "TimedVelocity2D", "target velocity")

param("speed", 0.2, { min = 0.01, max = 0.5, step = 0.01, widget = "slider", unit = "m/s", doc = "at most" })
param("near", 0.01, { min = 0.001, unit = "m", doc = "so near to the goal is there" })

local TURNED = math.rad(1) -- so well turned is turned

state.goal, state.mode = state.goal or { x = 0, y = 0, heading = 0 }, state.mode or {}
local heading = pid { kp = 4, min = -3, max = 3, angle = true }

--- How far the goal is, and in which direction as seen from the robot.
local function goal_seen(here)
  local goal = poses.to_local(here, state.goal)
  return math.sqrt(goal.x ^ 2 + goal.y ^ 2), math.atan(goal.y, goal.x)
end

--- Turns on the spot; true when that is done.
local function turn_to(direction, here)
  target:write { va = heading:update(direction, here.heading, dt) }
  return math.abs(angles.difference(here.heading, direction)) < TURNED
end

local machine = state_machine({
  initial = "rest",
  states = {
    rest = function() target:write {} end,
    face = function()
      local here = pose:read()
      local distance, bearing = goal_seen(here)
      if distance < config.near then return "arrive" end
      return turn_to(here.heading + bearing, here) and "drive" or nil
    end,
    drive = function()
      local here = pose:read()
      local distance, bearing = goal_seen(here)
      if distance < config.near then return "arrive" end
      if math.abs(bearing) > math.pi / 2 then return "face" end
      target:write {
        vx = math.min(config.speed, 2 * distance) * math.cos(bearing),
        va = heading:update(here.heading + bearing, here.heading, dt),
      }
    end,
    arrive = function() return turn_to(state.goal.heading, pose:read()) and "rest" or nil end,
  },
}, state.mode)

command("go", function(x, y, goal_heading)
  state.goal = { x = x, y = y, heading = goal_heading or 0 }
  machine:go("face", now())
end, "go(x, y, heading) [m, rad]: where to drive")

function on_execute() machine:update(now()) end

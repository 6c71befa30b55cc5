--- Knows where it is: an extended Kalman filter that goes on by odometry and is put right by markers whose places it knows.

local matrix = require "nezumi.matrix"
local poses = require "nezumi.poses"

local odometry = input("odometry", "TimedPose2D", "pose by the wheels; its origin is of no importance")
local marker   = input("marker", "TimedPose3D", "the nearest marker, as seen from the camera")
local id       = input("id", "TimedLong", "its number")
local pose     = output("pose", "TimedPose2D", "where the robot is")
local dead     = output("dead_reckoning", "TimedPose2D", "where it would be by odometry alone")
local spread   = output("deviation", "TimedDoubleSeq", "standard deviations of the pose: x [m], y [m], heading [rad]")

param("markers", { 0.0, 1.0, 0.0 }, { unit = "m", doc = "of each its number, x and y" })
param("initial", { 0.0, 0.0, 0.0 }, { min_size = 3, max_size = 3, doc = "x [m], y [m], heading [rad], about" })
param("camera", 0.05, { unit = "m", doc = "how far before the wheels' axis the camera is" })
param("latency", 0.04, { min = 0.0, unit = "s", doc = "from a picture to the position of its marker" })

-- Standard deviations: of the start [m], [rad]; of a second of driving [m], [rad]; of a marker's place, a part of its distance.
local START = { 0.2, 0.2, 0.3 }
local DRIFT = { 0.03, 0.03, 0.2 }
local SEEN  = 0.02

local function diagonal(deviations, factor)
  local m = matrix.zeros(3, 3)
  for i = 1, 3 do m[i][i] = factor * deviations[i] ^ 2 end
  return m
end

state.x = state.x or poses.plane(config.initial[1], config.initial[2], config.initial[3])
state.dead = state.dead or state.x
state.odometry = state.odometry or {} -- the poses since the picture that comes next was taken, oldest first
local x, p = state.x, matrix(state.p or diagonal(START, 1))

--- Goes on as the wheels say.
local function predict(here)
  local moved = poses.relative(state.odometry[#state.odometry] or here, here)
  local next = poses.compose(x, moved)
  local f = matrix { { 1, 0, x.position.y - next.position.y }, { 0, 1, next.position.x - x.position.x }, { 0, 0, 1 } }
  x, p = next, f * p * f:transpose() + diagonal(DRIFT, dt)
  state.dead = poses.compose(state.dead, moved)
  table.insert(state.odometry, here)
  if #state.odometry > config.latency / dt + 1.5 then table.remove(state.odometry, 1) end
end

--- Compares where a marker is seen, from the robot, with where it should be.
local function correct(seen, mx, my)
  local expected = poses.to_local(x, { x = mx, y = my })
  local c, s = math.cos(x.heading), math.sin(x.heading)
  local h = matrix { { -c, -s, expected.y }, { s, -c, -expected.x } }
  local r = SEEN ^ 2 * (seen.x ^ 2 + seen.y ^ 2) * matrix.identity(2)
  local gain = (h * p * h:transpose() + r):solve(h * p):transpose()
  local change = gain * matrix { { seen.x - expected.x }, { seen.y - expected.y } }
  x = poses.plane(x.position.x + change[1][1], x.position.y + change[2][1], x.heading + change[3][1])
  p = (matrix.identity(3) - gain * h) * p
end

function on_execute()
  if odometry.tm == 0 then return end
  local here = odometry:read()
  predict(here)
  if marker.is_new then
    -- It was seen some time ago: where it is from where the robot is by now.
    local at, number = marker:read().position, id:read()
    local seen = poses.to_local(poses.relative(state.odometry[1], here), { x = at.x + config.camera, y = at.y })
    for i = 1, #config.markers, 3 do
      if config.markers[i] == number then correct(seen, config.markers[i + 1], config.markers[i + 2]) end
    end
  end
  state.x, state.p = x, p
  pose:write(x)
  dead:write(state.dead)
  spread:write { p[1][1] ^ 0.5, p[2][2] ^ 0.5, p[3][3] ^ 0.5 }
end

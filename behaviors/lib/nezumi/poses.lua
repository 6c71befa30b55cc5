--- Frames in the plane and in space. Poses are as ports give them: `{ position = { x, y }, heading }` in the plane,
--- `{ position = { x, y, z }, orientation = { r, p, y } }` in space. Metres and radians; x ahead, y left, z up.

local angles = require "nezumi.angles"
local expect = require "nezumi.expect"

local poses = {}

--- A pose in the plane.
---@param x number [m]
---@param y number [m]
---@param heading number [rad], counter-clockwise
function poses.plane(x, y, heading)
  expect.number("poses.plane: x", x)
  expect.number("poses.plane: y", y)
  expect.number("poses.plane: heading", heading)
  return { position = { x = x, y = y }, heading = heading }
end

--- A pose in space: turned by `yaw` about z, then by `pitch` about the new y, then by `roll` about the new x.
---@param x number [m]
---@param y number [m]
---@param z number [m]
---@param roll number [rad]
---@param pitch number [rad]
---@param yaw number [rad]
function poses.space(x, y, z, roll, pitch, yaw)
  expect.number("poses.space: x", x)
  expect.number("poses.space: y", y)
  expect.number("poses.space: z", z)
  expect.number("poses.space: roll", roll)
  expect.number("poses.space: pitch", pitch)
  expect.number("poses.space: yaw", yaw)
  return { position = { x = x, y = y, z = z }, orientation = { r = roll, p = pitch, y = yaw } }
end

-- Whether a pose is one in space; an error unless it is one at all.
local function is_in_space(what, pose)
  local position = type(pose) == "table" and pose.position
  local fits = type(position) == "table" and type(position.x) == "number" and type(position.y) == "number"
  if fits and type(pose.heading) == "number" then return false end
  local turn = fits and pose.orientation
  if type(turn) == "table" and type(position.z) == "number" and type(turn.r) == "number"
    and type(turn.p) == "number" and type(turn.y) == "number" then
    return true
  end
  error(what .. " expected a pose: { position = { x, y }, heading }, or position with z and orientation = { r, p, y }", 3)
end

-- The rotation of a pose in space as the rows of its matrix: Rz(yaw) Ry(pitch) Rx(roll).
local function rotation(pose)
  local turn = pose.orientation
  local cr, sr, cp, sp = math.cos(turn.r), math.sin(turn.r), math.cos(turn.p), math.sin(turn.p)
  local cy, sy = math.cos(turn.y), math.sin(turn.y)
  return {
    { cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr },
    { sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr },
    { -sp, cp * sr, cp * cr },
  }
end

-- The angles of a rotation. Where x points straight up or down only the sum of roll and yaw counts: roll is 0 then.
local function orientation(m)
  local pitch = math.asin(math.max(-1, math.min(1, -m[3][1])))
  if math.abs(m[3][1]) > 1 - 1e-12 then return { r = 0, p = pitch, y = math.atan(-m[1][2], m[2][2]) } end
  return { r = math.atan(m[3][2], m[3][3]), p = pitch, y = math.atan(m[2][1], m[1][1]) }
end

local function turned(m, p)
  return {
    x = m[1][1] * p.x + m[1][2] * p.y + m[1][3] * p.z,
    y = m[2][1] * p.x + m[2][2] * p.y + m[2][3] * p.z,
    z = m[3][1] * p.x + m[3][2] * p.y + m[3][3] * p.z,
  }
end

local function turned_by(heading, p)
  local c, s = math.cos(heading), math.sin(heading)
  return { x = c * p.x - s * p.y, y = s * p.x + c * p.y }
end

-- From here on arguments are good.

local function place(frame, point)
  if frame.orientation == nil then
    local p = turned_by(frame.heading, point)
    return { x = frame.position.x + p.x, y = frame.position.y + p.y }
  end
  local p = turned(rotation(frame), point)
  return { x = frame.position.x + p.x, y = frame.position.y + p.y, z = frame.position.z + p.z }
end

local function compose(frame, pose)
  local position = place(frame, pose.position)
  if frame.orientation == nil then
    return { position = position, heading = angles.wrap(frame.heading + pose.heading) }
  end
  local a, b, product = rotation(frame), rotation(pose), { {}, {}, {} }
  for i = 1, 3 do
    for j = 1, 3 do product[i][j] = a[i][1] * b[1][j] + a[i][2] * b[2][j] + a[i][3] * b[3][j] end
  end
  return { position = position, orientation = orientation(product) }
end

local function inverse(pose)
  if pose.orientation == nil then
    local p = turned_by(-pose.heading, pose.position)
    return { position = { x = -p.x, y = -p.y }, heading = angles.wrap(-pose.heading) }
  end
  local m = rotation(pose)
  local back = { { m[1][1], m[2][1], m[3][1] }, { m[1][2], m[2][2], m[3][2] }, { m[1][3], m[2][3], m[3][3] } }
  local p = turned(back, pose.position)
  return { position = { x = -p.x, y = -p.y, z = -p.z }, orientation = orientation(back) }
end

--- The pose that is `pose` as seen from `frame`, as seen from where `frame` is seen from.
function poses.compose(frame, pose)
  if is_in_space("poses.compose", frame) ~= is_in_space("poses.compose", pose) then
    error("poses.compose expected two poses in the plane or two in space, got one of each", 2)
  end
  return compose(frame, pose)
end

--- Where the world is, as seen from `pose`: composed with `pose` it does not move anything.
function poses.inverse(pose)
  is_in_space("poses.inverse", pose)
  return inverse(pose)
end

--- `pose` as seen from `frame`, both given in the same frame.
function poses.relative(frame, pose)
  if is_in_space("poses.relative", frame) ~= is_in_space("poses.relative", pose) then
    error("poses.relative expected two poses in the plane or two in space, got one of each", 2)
  end
  return compose(inverse(frame), pose)
end

local function check_point(what, in_space, point)
  if type(point) == "table" and type(point.x) == "number" and type(point.y) == "number"
    and (not in_space or type(point.z) == "number") then
    return
  end
  error(("%s expected a point: { x, y%s }"):format(what, in_space and ", z" or ""), 3)
end

--- The point that is `point` as seen from `frame`, as seen from where `frame` is seen from: from a robot to the world.
---@param point { x: number, y: number, z: number? }
function poses.transform(frame, point)
  check_point("poses.transform", is_in_space("poses.transform", frame), point)
  return place(frame, point)
end

--- `point` as seen from `frame`: from the world to a robot.
---@param point { x: number, y: number, z: number? }
function poses.to_local(frame, point)
  check_point("poses.to_local", is_in_space("poses.to_local", frame), point)
  return place(inverse(frame), point)
end

return poses

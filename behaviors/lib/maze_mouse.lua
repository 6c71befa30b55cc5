--- A mouse in a maze of square cells: where it is, by its wheels and by the walls that it sees, what it has found out
--- about the walls, and how it gets from cell to cell. Cells are counted from 1; the first one's centre is the origin.
--- Directions are quarter turns: 0 looks along x, 1 along y, 0.5 along the diagonal between them. A column and a half is the
--- border between two cells. `turn`, `drive` and `forward` take time: they are for tasks.

local angles = require "nezumi.angles"
local grid = require "nezumi.grid"
local poses = require "nezumi.poses"

local CELL  = 0.18            -- distance of two walls, from middle to middle [m]
local FACE  = CELL / 2 - 0.006 -- from the middle of a cell to a wall [m]
local TRUST = 0.05            -- part of what a sensor says otherwise that is believed in each execution
local BRAKE = 1.0             -- m/s^2
local SPIN  = 8.0             -- rad/s^2: how it stops turning

--- The beams as seen from the mouse: right front, right side, left side, left front.
local beams = {
  poses.plane(0.035, -0.040, 0),
  poses.plane(0.045, -0.030, -math.pi / 4),
  poses.plane(0.045, 0.030, math.pi / 4),
  poses.plane(0.035, 0.040, 0),
}

local STEPS = { [0] = { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } }

---@class MazeMouse
---@field memory table column, row and direction that it drives to; here, where it is; map
---@field at table where it is, as seen from where it drives to
local Mouse = {}
Mouse.__index = Mouse

--- The centre of the cell that is driven to, looking as the mouse shall.
local function lane(memory)
  return poses.plane((memory.column - 1) * CELL, (memory.row - 1) * CELL, memory.direction * math.pi / 2)
end

local function aim(self, column, row, direction)
  local memory = self.memory
  memory.column, memory.row = math.tointeger(column) or column, math.tointeger(row) or row
  memory.direction = math.tointeger(direction) or direction
  self.at = poses.relative(lane(memory), memory.here)
end

--- Column and row, in the map, of what lies in a direction from a cell: there cells have even ones, walls are between them.
local function in_map(column, row, direction)
  local step = STEPS[direction % 4]
  return 2 * column + step[1], 2 * row + step[2]
end

--- What stands between a cell and the next one: true is a wall, false nothing, nil not known.
function Mouse:wall(column, row, direction)
  local evidence = self.map:evidence(in_map(column, row, direction))
  if evidence ~= 0 then return evidence > 0 end
end

local function know(self, column, row, direction, is_wall)
  local x, y = self.map:centre(in_map(column, row, direction))
  self.map:set(x, y, is_wall)
end

--- The cell next to one, or nil at the end of the map.
function Mouse:beside(column, row, direction)
  column, row = column + STEPS[direction][1], row + STEPS[direction][2]
  if column >= 1 and column <= self.columns and row >= 1 and row <= self.rows then return column, row end
end

--- Turns on the spot.
function Mouse:turn(direction)
  aim(self, self.memory.column, self.memory.row, direction)
  wait_until(function() return math.abs(self.at.heading) < 0.02 end)
end

--- How the place changes with half a cell: along the maze, or along a diagonal to the next border.
local function half_step(direction)
  local before, after = STEPS[direction // 1 % 4], STEPS[-(-direction // 1) % 4]
  if direction % 1 == 0 then return before[1] / 2, before[2] / 2 end
  return (before[1] + after[1]) / 2, (before[2] + after[2]) / 2
end

--- Drives so many half cells ahead, and looks at the walls of each cell as it comes to its border. On a diagonal, half a
--- cell leads from one border to the next, and no walls are looked at.
function Mouse:drive(halves)
  local column, row, direction = self.memory.column, self.memory.row, self.memory.direction
  local x, y = half_step(direction)
  aim(self, column + halves * x, row + halves * y, direction)
  for done = 0, halves - 1 do
    local at_column, at_row = column + done * x, row + done * y
    if direction % 1 == 0 and (at_column % 1 ~= 0 or at_row % 1 ~= 0) then
      wait_until(function() return self.at.position.x > -(halves - done) / 2 * CELL end)
      local seen = self.ranges
      local next_column, next_row = math.tointeger(at_column + x), math.tointeger(at_row + y)
      know(self, next_column, next_row, direction + 1, seen[3] < 0.12)
      know(self, next_column, next_row, direction, (seen[1] + seen[4]) / 2 < 0.22)
      know(self, next_column, next_row, direction + 3, seen[2] < 0.12)
    end
  end
  wait_until(function() return self.at.position.x > -0.003 end)
end

--- Drives so many cells ahead; 0: to the middle of this one.
function Mouse:forward(count) self:drive(2 * count) end

--- It was set down in the middle of a cell.
function Mouse:place(column, row, direction)
  local memory = self.memory
  memory.column, memory.row, memory.direction, memory.odometry = column, row, direction, nil
  memory.here = lane(memory)
end

--- What walls say of the place in the lane: those at the sides where it is across, one ahead where it is along, and both
--- in which direction it looks.
local function correct(at, ranges, speed, to_border)
  local x, y, turn = 0, 0, 0
  local tips = {}
  for i, beam in ipairs(beams) do tips[i] = poses.transform(poses.compose(at, beam), { x = ranges[i], y = 0 }) end
  if math.min(ranges[1], ranges[4]) > 0.08 then -- else the beams to the sides may end at the wall ahead
    for i, face in pairs { [2] = -FACE, [3] = FACE } do
      local off = tips[i].y - face
      if math.abs(off) < 0.02 then y, turn = y + off, turn + 5 * speed / 0.25 * off end
    end
  end
  if math.max(ranges[1], ranges[4]) < 0.15 then
    local off = (tips[1].x + tips[4].x) / 2 - FACE + (to_border and CELL / 2 or 0)
    x, turn = off - CELL * ((off + CELL / 2) // CELL), turn + (tips[1].x - tips[4].x) / 0.08
  end
  return poses.plane(at.position.x - TRUST * x, at.position.y - TRUST * y, at.heading - TRUST * turn)
end

--- To be called in each execution with what the wheels and the sensors say: the velocity to drive with.
function Mouse:update(odometry, ranges, speed)
  local memory = self.memory
  memory.here = poses.compose(memory.here, poses.relative(memory.odometry or odometry, odometry))
  memory.odometry, self.ranges = odometry, ranges
  local at = poses.relative(lane(memory), memory.here)
  if math.abs(at.heading) < 0.1 and memory.direction % 1 == 0 then
    at = correct(at, ranges, memory.moving and speed or 0, memory.column % 1 ~= 0 or memory.row % 1 ~= 0)
    memory.here = poses.compose(lane(memory), at)
  end
  self.at = at

  local left = -at.position.x
  memory.moving = math.abs(at.heading) <= 0.3 and math.abs(left) >= 0.003
  if not memory.moving then
    local rate = math.min(5, math.sqrt(2 * SPIN * math.abs(at.heading))) -- rad/s
    return { va = at.heading > 0 and -rate or rate }
  end
  local vx = math.min(speed, math.sqrt(2 * BRAKE * math.abs(left)))
  local bearing = angles.wrap(math.atan(-at.position.y, 0.1) - at.heading)
  return { vx = left > 0 and vx or -vx, va = 6 * bearing }
end

--- `maze_mouse(column, row, direction, state.mouse, { columns, rows })`: a mouse that stands in the middle of a cell. As the
--- contests have it, that cell has walls on three sides. The maze has at most so many cells, 16 by 16 if not said.
return function(column, row, direction, memory, size)
  local begins = memory.here == nil
  if begins then
    memory.column, memory.row, memory.direction, memory.map = column, row, direction, {}
    memory.here = lane(memory)
  end
  local self = setmetatable({ memory = memory }, Mouse)
  self.columns, self.rows = table.unpack(size or { 16, 16 })
  self.map = grid({
    columns = 2 * self.columns + 1, rows = 2 * self.rows + 1, cell = CELL / 2, x = -0.75 * CELL, y = -0.75 * CELL,
  }, memory.map)
  if begins then
    for turn = 0, 3 do know(self, column, row, direction + turn, turn ~= 0) end
  end
  return self
end

--- Paths through occupancy grids: the shortest one by A*, and the point on it to steer for.

local expect = require "nezumi.expect"

local path = {}

local DIAGONAL = math.sqrt(2)
local STEPS = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 1, 1 }, { -1, 1 }, { -1, -1 }, { 1, -1 } }

-- A binary heap of cells, the least cost first; of equal ones that which was pushed first.

local function before(a, b) return a.cost < b.cost or (a.cost == b.cost and a.order < b.order) end

local function push(heap, index, cost)
  heap.pushed = (heap.pushed or 0) + 1
  local entry, i = { index = index, cost = cost, order = heap.pushed }, #heap + 1
  while i > 1 and before(entry, heap[i // 2]) do
    heap[i] = heap[i // 2]
    i = i // 2
  end
  heap[i] = entry
end

local function pop(heap)
  local top, last, i = heap[1], table.remove(heap), 1
  while 2 * i <= #heap do
    local child = 2 * i
    if child < #heap and before(heap[child + 1], heap[child]) then child = child + 1 end
    if not before(heap[child], last) then break end
    heap[i] = heap[child]
    i = child
  end
  if #heap > 0 then heap[i] = last end
  return top.index
end

-- The cells whose centres are within `clearance` of that of an occupied one, and unknown ones unless they are free.
local function blocked_cells(grid, clearance, unknown_is_free)
  local columns, rows, cells = grid.columns, grid.rows, grid.memory.cells
  local reach, around = clearance / grid.cell, {}
  local whole = math.tointeger(math.min(reach // 1, columns + rows))
  for dy = -whole, whole do
    for dx = -whole, whole do
      if dx * dx + dy * dy <= reach * reach then around[#around + 1] = { dx, dy } end
    end
  end
  local blocked = {}
  for row = 1, rows do
    for column = 1, columns do
      local index = (row - 1) * columns + column
      if cells[index] > 0 then
        for _, step in ipairs(around) do
          local c, r = column + step[1], row + step[2]
          if c >= 1 and c <= columns and r >= 1 and r <= rows then blocked[(r - 1) * columns + c] = true end
        end
      elseif cells[index] == 0 and not unknown_is_free then
        blocked[index] = true
      end
    end
  end
  return blocked
end

-- From the goal back to the start, as corners only, the first and the last being the places themselves.
local function corners(grid, came_from, from, to, goal)
  local indices = { goal }
  while came_from[indices[#indices]] do indices[#indices + 1] = came_from[indices[#indices]] end
  local points = { { x = from.x, y = from.y } }
  for i = #indices - 1, 2, -1 do
    if indices[i + 1] - indices[i] ~= indices[i] - indices[i - 1] then
      local x, y = grid:centre((indices[i] - 1) % grid.columns + 1, (indices[i] - 1) // grid.columns + 1)
      points[#points + 1] = { x = x, y = y }
    end
  end
  points[#points + 1] = { x = to.x, y = to.y }
  return points
end

local function check_point(what, point)
  if type(point) ~= "table" or type(point.x) ~= "number" or type(point.y) ~= "number" then
    error(what .. " expected a point: { x, y }", 3)
  end
end

--- The shortest way from cell to cell (A*: Hart, Nilsson and Raphael 1968), also diagonally where both cells beside are
--- free, as its corners. Nil and the reason when there is none. `clearance` [m] is how far the middle of the robot stays
--- from occupied cells, and is not asked of the start; `unknown = "blocked"` keeps off cells of which nothing is known.
---@param grid nezumi.Grid
---@param from { x: number, y: number } [m]
---@param to { x: number, y: number } [m]
---@param options { clearance: number?, unknown: "free"|"blocked"|nil }?
---@return { x: number, y: number }[]? corners from `from` to `to`
---@return string? reason
function path.find(grid, from, to, options)
  expect.kind("path.find: grid", grid, "table")
  check_point("path.find: from", from)
  check_point("path.find: to", to)
  options = expect.fields("path.find: options", options or {}, { "clearance", "unknown" })
  local clearance = expect.not_negative("path.find: clearance", options.clearance or 0)
  local unknown = options.unknown or "free"
  if unknown ~= "free" and unknown ~= "blocked" then
    error("path.find: unknown expected 'free' or 'blocked', got " .. tostring(unknown), 2)
  end

  local columns, rows = grid.columns, grid.rows
  local start_column, start_row = grid:cell_at(from.x, from.y)
  local goal_column, goal_row = grid:cell_at(to.x, to.y)
  if not start_column then return nil, "the start is outside of the grid" end
  if not goal_column then return nil, "the goal is outside of the grid" end
  local start, goal = (start_row - 1) * columns + start_column, (goal_row - 1) * columns + goal_column
  local blocked = blocked_cells(grid, clearance, unknown == "free")
  if blocked[goal] then return nil, "the goal is blocked" end

  -- What is left at least, over free ground.
  local function estimate(column, row)
    local dx, dy = math.abs(goal_column - column), math.abs(goal_row - row)
    return math.max(dx, dy) + (DIAGONAL - 1) * math.min(dx, dy)
  end
  local open, cost, came_from, done = {}, { [start] = 0 }, {}, {}
  push(open, start, 0)
  while #open > 0 do
    local index = pop(open)
    if index == goal then return corners(grid, came_from, from, to, goal) end
    if not done[index] then -- else it is an older entry with a longer way
      done[index] = true
      local column, row = (index - 1) % columns + 1, (index - 1) // columns + 1
      for _, step in ipairs(STEPS) do
        local c, r = column + step[1], row + step[2]
        local next_index = (r - 1) * columns + c
        local diagonal = step[1] ~= 0 and step[2] ~= 0
        local cuts_corner = diagonal and (blocked[index + step[1]] or blocked[index + step[2] * columns])
        if c >= 1 and c <= columns and r >= 1 and r <= rows and not blocked[next_index] and not cuts_corner then
          local way = cost[index] + (diagonal and DIAGONAL or 1)
          if way < (cost[next_index] or math.huge) then
            cost[next_index], came_from[next_index] = way, index
            push(open, next_index, way + estimate(c, r))
          end
        end
      end
    end
  end
  return nil, "there is no way"
end

--- The length of a way [m].
---@param points { x: number, y: number }[]
---@return number
function path.length(points)
  expect.kind("path.length: points", points, "table")
  local sum = 0
  for i = 2, #points do
    sum = sum + math.sqrt((points[i].x - points[i - 1].x) ^ 2 + (points[i].y - points[i - 1].y) ^ 2)
  end
  return sum
end

--- The point to steer for (pure pursuit, Coulter 1992): that which lies `distance` further along the way than the one
--- nearest to `position`; the end when there is no more.
---@param points { x: number, y: number }[] at least one
---@param position { x: number, y: number } [m]
---@param distance number [m]
---@return { x: number, y: number }
function path.ahead(points, position, distance)
  expect.kind("path.ahead: points", points, "table")
  expect.whole("path.ahead: the number of points", #points, 1, math.maxinteger)
  check_point("path.ahead: position", position)
  expect.not_negative("path.ahead: distance", distance)
  -- The nearest point: on which leg, and which part of it is behind.
  local nearest, leg, part = math.huge, #points
  for i = 1, #points - 1 do
    local a, b = points[i], points[i + 1]
    local dx, dy = b.x - a.x, b.y - a.y
    local along = ((position.x - a.x) * dx + (position.y - a.y) * dy) / math.max(dx * dx + dy * dy, 1e-12)
    along = math.max(0, math.min(1, along))
    local off = (a.x + along * dx - position.x) ^ 2 + (a.y + along * dy - position.y) ^ 2
    if off < nearest then nearest, leg, part = off, i, along end
  end
  for i = leg, #points - 1 do
    local a, b = points[i], points[i + 1]
    local dx, dy = b.x - a.x, b.y - a.y
    local length = math.sqrt(dx * dx + dy * dy)
    local left = (1 - part) * length
    if distance < left then
      local along = part + distance / length
      return { x = a.x + along * dx, y = a.y + along * dy }
    end
    distance, part = distance - left, 0
  end
  return { x = points[#points].x, y = points[#points].y }
end

return path
